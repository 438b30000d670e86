// SPDX-License-Identifier: BSD-2-Clause
// The traversal for x86-64 machines with AVX-512: a vector of eight is half a register, of which
// there are 32, with masks and compression.
#include "accelerators/bvh/traverse.h"

#if defined(EXPHOTON_BVH_AVX)
#include <immintrin.h>

#include <bit>

#include "core/geometry/triangle_decide.h"
#include "core/scene/aggregate.h"
#include "core/scene/hit_order.h"

// From here on, and not for the headers above: an inline function of theirs that was compiled for
// AVX-512 could replace the one that other files use.
#if defined(__clang__)
#pragma clang attribute push( \
    __attribute__((target("avx512f,avx512vl,avx512dq,avx2,fma,bmi,popcnt"))), apply_to = function)
#else
#pragma GCC push_options
#pragma GCC target("avx512f,avx512vl,avx512dq,avx2,fma,bmi,popcnt")
#endif

namespace exphoton {
namespace {

struct Real8 {
  __m256 v;

  static Real8 Load(const Real* row) { return {_mm256_load_ps(row)}; }
  static Real8 All(Real x) { return {_mm256_set1_ps(x)}; }
};

inline Real8 operator-(Real8 a, Real8 b) { return {_mm256_sub_ps(a.v, b.v)}; }
inline Real8 operator*(Real8 a, Real8 b) { return {_mm256_mul_ps(a.v, b.v)}; }
inline Real8 MultiplyAdd(Real8 a, Real8 b, Real8 c) { return {_mm256_fmadd_ps(a.v, b.v, c.v)}; }
inline Real8 Min(Real8 a, Real8 b) { return {_mm256_min_ps(a.v, b.v)}; }  // NaN: the second
inline Real8 Max(Real8 a, Real8 b) { return {_mm256_max_ps(a.v, b.v)}; }
inline unsigned LessMask(Real8 a, Real8 b) { return _mm256_cmp_ps_mask(a.v, b.v, _CMP_LT_OQ); }

inline unsigned PresentMask(const std::uint32_t* ids) {
  const __m256i row = _mm256_load_si256(reinterpret_cast<const __m256i*>(ids));
  return _mm256_cmpneq_epi32_mask(row, _mm256_set1_epi32(-1));
}

class PushOrder {
 public:
  explicit PushOrder(bool isOpposite)
      : shifts_(isOpposite ? _mm256_setr_epi32(0, 3, 6, 9, 12, 15, 18, 21)
                           : _mm256_setr_epi32(21, 18, 15, 12, 9, 6, 3, 0)) {}

  // Puts the children where first <= last on the stack, the first of the order on top; returns how
  // many. Permutations heed the three low bits of an index only.
  std::size_t Push(const BvhNode& node, std::size_t orderIndex, Real8 first, Real8 last,
                   BvhChild* children, Real* enters) const {
    const __m256i order =
        _mm256_srlv_epi32(_mm256_set1_epi32(int(node.orders[orderIndex])), shifts_);
    const __m256 firsts = _mm256_permutexvar_ps(order, first.v);
    const __m256 lasts = _mm256_permutexvar_ps(order, last.v);
    const __m256i all = _mm256_permutexvar_epi32(
        order, _mm256_load_si256(reinterpret_cast<const __m256i*>(node.children)));
    const __mmask8 mask = _mm256_cmp_ps_mask(firsts, lasts, _CMP_LE_OQ);
    // Compressed in registers: straight to memory is slow on some machines.
    _mm256_storeu_si256(reinterpret_cast<__m256i*>(children),
                        _mm256_maskz_compress_epi32(mask, all));
    _mm256_storeu_ps(enters, _mm256_maskz_compress_ps(mask, firsts));
    return std::size_t(std::popcount(unsigned(mask)));
  }

 private:
  __m256i shifts_;
};

#include "accelerators/bvh/traverse.inl"

}  // namespace

const BvhTraversal kAvx512Traversal{"AVX-512", Intersect, Occluded, IntersectBlocks,
                                    OccludedByBlocks};

}  // namespace exphoton

#if defined(__clang__)
#pragma clang attribute pop
#else
#pragma GCC pop_options
#endif
#endif
