// SPDX-License-Identifier: BSD-2-Clause
// The traversal for x86-64 machines with AVX2: a vector of eight is one register.
#include "accelerators/bvh/traverse.h"

#if defined(EXPHOTON_BVH_AVX2)
#include <immintrin.h>

#include <array>

#include "core/geometry/triangle_decide.h"
#include "core/scene/aggregate.h"
#include "core/scene/hit_order.h"

// From here on, and not for the headers above: an inline function of theirs that was compiled for
// AVX2 could replace the one that other files use.
#if defined(__clang__)
#pragma clang attribute push(__attribute__((target("avx2,bmi"))), apply_to = function)
#else
#pragma GCC push_options
#pragma GCC target("avx2,bmi")
#endif

namespace exphoton {
namespace {

struct Real8 {
  __m256 v;

  static Real8 Load(const Real* row) { return {_mm256_load_ps(row)}; }
  static Real8 All(Real x) { return {_mm256_set1_ps(x)}; }
  void Store(Real* row) const { _mm256_store_ps(row, v); }
};

inline Real8 operator+(Real8 a, Real8 b) { return {_mm256_add_ps(a.v, b.v)}; }
inline Real8 operator-(Real8 a, Real8 b) { return {_mm256_sub_ps(a.v, b.v)}; }
inline Real8 operator*(Real8 a, Real8 b) { return {_mm256_mul_ps(a.v, b.v)}; }
inline Real8 Min(Real8 a, Real8 b) { return {_mm256_min_ps(a.v, b.v)}; }  // NaN: the second
inline Real8 Max(Real8 a, Real8 b) { return {_mm256_max_ps(a.v, b.v)}; }
inline unsigned LessEqualMask(Real8 a, Real8 b) {
  return unsigned(_mm256_movemask_ps(_mm256_cmp_ps(a.v, b.v, _CMP_LE_OQ)));
}
inline unsigned LessMask(Real8 a, Real8 b) {
  return unsigned(_mm256_movemask_ps(_mm256_cmp_ps(a.v, b.v, _CMP_LT_OQ)));
}

#include "accelerators/bvh/traverse.inl"

}  // namespace

const BvhTraversal kAvx2Traversal{"AVX2", Intersect, Occluded};

}  // namespace exphoton

#if defined(__clang__)
#pragma clang attribute pop
#else
#pragma GCC pop_options
#endif
#endif
