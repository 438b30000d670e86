// SPDX-License-Identifier: BSD-2-Clause
// The loops over cone axes for wider vectors.
#pragma once

#include "integrators/photon/gather/cone_directions.h"

namespace exphoton {

#if defined(EXPHOTON_WIDE_VECTORS)
extern const ConeLoops kConeLoopsAvx2;    // call only where the machine has AVX2
extern const ConeLoops kConeLoopsAvx512;  // and AVX-512 F
#endif

}  // namespace exphoton
