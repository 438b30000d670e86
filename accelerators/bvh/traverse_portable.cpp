// SPDX-License-Identifier: BSD-2-Clause
// The traversal for any machine: vectors of eight as loops that the compiler maps to what there is
// (x86-64: pairs of SSE registers). Also the choice between the traversals.
#include <array>

#include "accelerators/bvh/traverse.h"
#include "core/geometry/triangle_decide.h"
#include "core/scene/aggregate.h"
#include "core/scene/hit_order.h"

namespace exphoton {
namespace {

struct Real8 {
  Real lanes[kBvhWidth];

  static Real8 Load(const Real* row) {
    Real8 r;
    for (int i = 0; i < kBvhWidth; ++i) r.lanes[i] = row[i];
    return r;
  }
  static Real8 All(Real x) {
    Real8 r;
    for (Real& lane : r.lanes) lane = x;
    return r;
  }
  void Store(Real* row) const {
    for (int i = 0; i < kBvhWidth; ++i) row[i] = lanes[i];
  }
};

#define EXPHOTON_LANEWISE(name, expression)           \
  inline Real8 name(const Real8& a, const Real8& b) { \
    Real8 r;                                          \
    for (int i = 0; i < kBvhWidth; ++i) {             \
      const Real x = a.lanes[i], y = b.lanes[i];      \
      r.lanes[i] = (expression);                      \
    }                                                 \
    return r;                                         \
  }
EXPHOTON_LANEWISE(operator+, x + y)
EXPHOTON_LANEWISE(operator-, x - y)
EXPHOTON_LANEWISE(operator*, x* y)
EXPHOTON_LANEWISE(Min, x < y ? x : y)  // the second where one is NaN
EXPHOTON_LANEWISE(Max, x > y ? x : y)
#undef EXPHOTON_LANEWISE

// A bit a lane where a <= b, or a < b; none for NaN.
inline unsigned LessEqualMask(const Real8& a, const Real8& b) {
  unsigned mask = 0;
  for (int i = 0; i < kBvhWidth; ++i) mask |= unsigned(a.lanes[i] <= b.lanes[i]) << i;
  return mask;
}
inline unsigned LessMask(const Real8& a, const Real8& b) {
  unsigned mask = 0;
  for (int i = 0; i < kBvhWidth; ++i) mask |= unsigned(a.lanes[i] < b.lanes[i]) << i;
  return mask;
}

#include "accelerators/bvh/traverse.inl"

}  // namespace

const BvhTraversal kPortableTraversal{"portable", Intersect, Occluded};

const BvhTraversal& FastestTraversal([[maybe_unused]] BvhVectors widest) {
#if defined(EXPHOTON_BVH_AVX2)
  if (widest >= BvhVectors::Avx2 && __builtin_cpu_supports("avx2")) return kAvx2Traversal;
#endif
  return kPortableTraversal;
}

}  // namespace exphoton
