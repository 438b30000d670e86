// SPDX-License-Identifier: BSD-2-Clause
// kAvx512Traversal is the traversal for x86-64 machines with AVX-512. Eight Reals fill half a
// register. The target has 32 registers, masks and compression.
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
// inline function of theirs that was compiled for AVX-512 in other files, too.
#if defined(__clang__)
#pragma clang attribute push( \
    __attribute__((target("avx512f,avx512vl,avx512dq,avx2,fma,bmi,popcnt"))), apply_to = function)
#else
#pragma GCC push_options
#pragma GCC target("avx512f,avx512vl,avx512dq,avx2,fma,bmi,popcnt")
#endif

namespace exphoton {
namespace {

#include "accelerators/bvh/traverse/real8_avx.inl"

inline unsigned LessMask(Real8 a, Real8 b) { return _mm256_cmp_ps_mask(a.v, b.v, _CMP_LT_OQ); }

inline unsigned PresentMask(const std::uint32_t* ids) {
  const __m256i row = _mm256_load_si256(reinterpret_cast<const __m256i*>(ids));
  return _mm256_cmpneq_epi32_mask(row, _mm256_set1_epi32(-1));
}

class PushOrder : PlaceOrder {
 public:
  using PlaceOrder::PlaceOrder;

  std::size_t Push(const BvhNode& node, std::size_t orderIndex, Real8 first, Real8 last,
                   BvhChild* children, Real* enters, BvhChild* next) const {
    const BvhOrder places = node.orders[orderIndex];
    const __m256i order = Lanes(places);
    const __m256 firsts = _mm256_permutexvar_ps(order, first.v);
    const __m256 lasts = _mm256_permutexvar_ps(order, last.v);
    const __mmask8 met = _mm256_cmp_ps_mask(firsts, lasts, _CMP_LE_OQ);
    if (met == 0) return 0;
    *next = node.children[LastLane(places, met)];
    const __m256i all = _mm256_permutexvar_epi32(
        order, _mm256_load_si256(reinterpret_cast<const __m256i*>(node.children)));
    // The lanes are compressed in registers, because compressing straight to memory is slow on some
    // machines.
    _mm256_storeu_si256(reinterpret_cast<__m256i*>(children),
                        _mm256_maskz_compress_epi32(met, all));
    _mm256_storeu_ps(enters, _mm256_maskz_compress_ps(met, firsts));
    return std::size_t(std::popcount(unsigned(met)));
  }
};

#include "accelerators/bvh/traverse/traverse.inl"

}  // namespace

const BvhTraversal kAvx512Traversal{"AVX-512",       Intersect, Occluded,        MakeBlockRay,
                                    IntersectBlocks, Settle,    OccludedByBlocks};

}  // namespace exphoton

#include "core/math/simd/vectors_end.inl"
#endif
