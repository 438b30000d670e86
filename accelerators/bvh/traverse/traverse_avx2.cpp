// SPDX-License-Identifier: BSD-2-Clause
// kAvx2Traversal is the traversal for x86-64 machines with AVX2. Eight Reals fill one register.
#include "accelerators/bvh/traverse/traverse.h"

#if defined(EXPHOTON_BVH_AVX)
#include <immintrin.h>

#include <bit>
#include <cstddef>
#include <new>

#include "core/geometry/triangle_single.h"
#include "core/scene/aggregate.h"
#include "core/scene/hit_order.h"

// The target applies from here on and not to the headers above. Otherwise the linker could use an
// inline function of theirs that was compiled for AVX2 in other files, too.
#if defined(__clang__)
#pragma clang attribute push(__attribute__((target("avx2,fma,bmi,popcnt"))), apply_to = function)
#else
#pragma GCC push_options
#pragma GCC target("avx2,fma,bmi,popcnt")
#endif

namespace exphoton {
namespace {

#include "accelerators/bvh/traverse/real8_avx.inl"

inline unsigned LessMask(Real8 a, Real8 b) {
  return unsigned(_mm256_movemask_ps(_mm256_cmp_ps(a.v, b.v, _CMP_LT_OQ)));
}

inline unsigned PresentMask(const std::uint32_t* ids) {
  const __m256i row = _mm256_load_si256(reinterpret_cast<const __m256i*>(ids));
  const __m256i isMissing = _mm256_cmpeq_epi32(row, _mm256_set1_epi32(-1));
  return unsigned(~_mm256_movemask_ps(_mm256_castsi256_ps(isMissing))) & 0xff;
}

// Gathering lists, for each mask, the lanes that are set, the lowest first. Permuting by this list
// moves them together.
struct Gathering {
  std::uint64_t lanes[256];  // a byte per lane
  constexpr Gathering() : lanes() {
    for (unsigned mask = 0; mask < 256; ++mask)
      for (unsigned lane = 0, count = 0; lane < kBvhWidth; ++lane)
        if (mask >> lane & 1) lanes[mask] |= std::uint64_t(lane) << (8 * count++);
  }
};
constexpr Gathering kGathering;

class PushOrder : PlaceOrder {
 public:
  using PlaceOrder::PlaceOrder;

  std::size_t Push(const BvhNode& node, std::size_t orderIndex, Real8 first, Real8 last,
                   BvhChild* children, Real* enters, BvhChild* next) const {
    const BvhOrder places = node.orders[orderIndex];
    const __m256i order = Lanes(places);
    const __m256 firsts = _mm256_permutevar8x32_ps(first.v, order);
    const __m256 lasts = _mm256_permutevar8x32_ps(last.v, order);
    const auto met = unsigned(_mm256_movemask_ps(_mm256_cmp_ps(firsts, lasts, _CMP_LE_OQ)));
    if (met == 0) return 0;
    *next = node.children[LastLane(places, met)];
    const __m256i all = _mm256_permutevar8x32_epi32(
        _mm256_load_si256(reinterpret_cast<const __m256i*>(node.children)), order);
    const __m256i together =
        _mm256_cvtepu8_epi32(_mm_cvtsi64_si128(std::int64_t(kGathering.lanes[met])));
    _mm256_storeu_si256(reinterpret_cast<__m256i*>(children),
                        _mm256_permutevar8x32_epi32(all, together));
    _mm256_storeu_ps(enters, _mm256_permutevar8x32_ps(firsts, together));
    return std::size_t(std::popcount(met));
  }
};

#include "accelerators/bvh/traverse/traverse.inl"

}  // namespace

const BvhTraversal kAvx2Traversal{"AVX2",          Intersect, Occluded,        MakeBlockRay,
                                  IntersectBlocks, Settle,    OccludedByBlocks};

}  // namespace exphoton

#include "core/math/simd/vectors_end.inl"
#endif
