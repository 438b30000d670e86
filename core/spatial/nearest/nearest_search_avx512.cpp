// SPDX-License-Identifier: BSD-2-Clause
// The searches for x86-64 machines with AVX-512. A Real16 is one register. Lanes are compressed in
// registers and stored whole, because compressing stores are slow on some machines.
#include "core/spatial/nearest/nearest_search.h"

#if defined(EXPHOTON_WIDE_VECTORS)
#include "core/math/simd/real16_begin_avx512.inl"

namespace exphoton {
namespace {

#include "core/math/simd/real16_avx512.inl"
#include "core/spatial/nearest/nearest_search.inl"

}  // namespace

const NearestSearch kAvx512NearestSearch{"AVX-512", FindBlockNear, Nearest, Closest};

}  // namespace exphoton

#include "core/math/simd/vectors_end.inl"
#endif
