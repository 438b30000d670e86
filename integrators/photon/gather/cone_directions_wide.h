// SPDX-License-Identifier: BSD-2-Clause
// This header declares the loops over cone axes for wider SIMD targets.
#pragma once

#include "integrators/photon/gather/cone_directions.h"

namespace exphoton {

#if defined(EXPHOTON_WIDE_VECTORS)
extern const ConeLoops kConeLoopsAvx2;    // call only if the machine has AVX2
extern const ConeLoops kConeLoopsAvx512;  // call only if the machine has AVX-512 F
#endif

}  // namespace exphoton
