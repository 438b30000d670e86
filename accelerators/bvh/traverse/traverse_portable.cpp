// SPDX-License-Identifier: BSD-2-Clause
// kPortableTraversal is the traversal for any machine. Its vectors of eight are loops, which the
// compiler maps to the available instructions (x86-64: pairs of SSE registers). This file also
// chooses between the traversals.
#include <array>
#include <new>

#include "accelerators/bvh/traverse/traverse.h"
#include "core/base/simd_targets.h"
#include "core/geometry/triangle_single.h"
#include "core/scene/aggregate.h"
#include "core/scene/hit_order.h"

namespace exphoton {
namespace {

template <int kCount>
struct Lanes {
  Real lanes[kCount];

  static Lanes Load(const Real* row) {
    Lanes r;
    for (int i = 0; i < kCount; ++i) r.lanes[i] = row[i];
    return r;
  }
  static Lanes All(Real x) {
    Lanes r;
    for (Real& lane : r.lanes) lane = x;
    return r;
  }
  void Store(Real* row) const {
    for (int i = 0; i < kCount; ++i) row[i] = lanes[i];
  }
};
using Real8 = Lanes<kBvhWidth>;

#define EXPHOTON_LANEWISE(name, expression)                                   \
  template <int kCount>                                                       \
  inline Lanes<kCount> name(const Lanes<kCount>& a, const Lanes<kCount>& b) { \
    Lanes<kCount> r;                                                          \
    for (int i = 0; i < kCount; ++i) {                                        \
      const Real x = a.lanes[i], y = b.lanes[i];                              \
      r.lanes[i] = (expression);                                              \
    }                                                                         \
    return r;                                                                 \
  }
EXPHOTON_LANEWISE(operator+, x + y)
EXPHOTON_LANEWISE(operator-, x - y)
EXPHOTON_LANEWISE(operator*, x* y)
EXPHOTON_LANEWISE(operator/, x / y)
EXPHOTON_LANEWISE(Min, x < y ? x : y)  // the second where one is NaN
EXPHOTON_LANEWISE(Max, x > y ? x : y)
#undef EXPHOTON_LANEWISE
inline Real8 MultiplyAdd(const Real8& a, const Real8& b, const Real8& c) { return a * b + c; }

constexpr bool kHitsInSingle = false;
inline bool IsWorthTracing(const Ray& ray) { return IsTraceable(ray); }

// Lanes 0 to 2 are the axes. The last lane holds 1, so division by it is safe.
using Axes = Lanes<4>;
inline Axes AxesOf(const Vec3& a) { return {{a.x, a.y, a.z, 1}}; }
template <int kCount>
inline Lanes<kCount> Abs(const Lanes<kCount>& a) {
  Lanes<kCount> r;
  for (int i = 0; i < kCount; ++i) r.lanes[i] = std::abs(a.lanes[i]);
  return r;
}
inline Real8 AllOf(const Axes& a, int axis) { return Real8::All(a.lanes[axis]); }

// Returns a mask with a bit for each lane where a < b. NaN gives no bit.
inline unsigned LessMask(const Real8& a, const Real8& b) {
  unsigned mask = 0;
  for (int i = 0; i < kBvhWidth; ++i) mask |= unsigned(a.lanes[i] < b.lanes[i]) << i;
  return mask;
}
inline unsigned PresentMask(const std::uint32_t* ids) {
  unsigned mask = 0;
  for (int i = 0; i < kBvhWidth; ++i) mask |= unsigned(ids[i] != kNoId) << i;
  return mask;
}

class PushOrder {
 public:
  explicit PushOrder(bool isOpposite) : isOpposite_(isOpposite) {}

  std::size_t Push(const BvhNode& node, std::size_t orderIndex, const Real8& first,
                   const Real8& last, BvhChild* children, Real* enters, BvhChild* next) const {
    const BvhOrder order = node.orders[orderIndex];
    std::size_t count = 0;
    for (int i = 0; i < kBvhWidth; ++i) {
      const unsigned lane = order >> (isOpposite_ ? 4 * i : 28 - 4 * i) & 7;
      children[count] = node.children[lane];
      enters[count] = first.lanes[lane];
      count += first.lanes[lane] <= last.lanes[lane];
    }
    if (count > 0) *next = children[count - 1];
    return count;
  }

 private:
  bool isOpposite_;
};

#include "accelerators/bvh/traverse/traverse.inl"

}  // namespace

const BvhTraversal kPortableTraversal{"portable",      Intersect, Occluded,        MakeBlockRay,
                                      IntersectBlocks, Settle,    OccludedByBlocks};

const BvhTraversal& FastestTraversal([[maybe_unused]] BvhVectors widest) {
#if defined(EXPHOTON_BVH_AVX)
  const std::size_t targets = UsableSimdTargets();
  if (widest >= BvhVectors::Widest && targets >= 3) return kAvx512Traversal;
  if (widest >= BvhVectors::Avx2 && targets >= 2) return kAvx2Traversal;
#endif
  return kPortableTraversal;
}

}  // namespace exphoton
