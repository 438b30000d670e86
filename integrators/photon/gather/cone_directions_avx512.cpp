// SPDX-License-Identifier: BSD-2-Clause
// This file compiles the loops over cone axes for x86-64 machines with AVX-512.
#include "integrators/photon/gather/cone_directions_wide.h"

#if defined(EXPHOTON_WIDE_VECTORS)
#include "core/math/simd/real16_begin_avx512.inl"

namespace exphoton {
namespace {

#include "core/math/simd/real16_avx512.inl"
#include "integrators/photon/gather/cone_directions.inl"

}  // namespace

const ConeLoops kConeLoopsAvx512 = kLoops;

}  // namespace exphoton

#include "core/math/simd/vectors_end.inl"
#endif
