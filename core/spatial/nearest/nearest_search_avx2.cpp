// SPDX-License-Identifier: BSD-2-Clause
// The searches for x86-64 machines with AVX2. A Real16 occupies two registers. Lanes are compressed
// by permutations from a table.
#include "core/spatial/nearest/nearest_search.h"

#if defined(EXPHOTON_WIDE_VECTORS)
#include "core/math/simd/real16_begin_avx2.inl"

namespace exphoton {
namespace {

#include "core/math/simd/real16_avx2.inl"
#include "core/spatial/nearest/nearest_search.inl"

}  // namespace

const NearestSearch kAvx2NearestSearch{"AVX2", FindBlockNear, Nearest, Closest};

}  // namespace exphoton

#include "core/math/simd/vectors_end.inl"
#endif
