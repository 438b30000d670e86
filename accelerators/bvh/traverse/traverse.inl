// SPDX-License-Identifier: BSD-2-Clause
// The traversal of the BVH. This file is part of traverse_simd.cpp, which defines before it the
// vectors of a SIMD target (core/math/simd/reals.inl, real8.inl).
//
// A ray enters every box that a computed hit of it may lie in. The computed hit at t may lie up to
// slope * t off the ray on each axis, with slope = kBvhMargin * |d|. The ray is thus a thin cone.
// It crosses a plane at the earliest at (plane - o) / (|d_axis| + slope) and at the latest at
// (plane - o) / (|d_axis| - slope). If the ray is perpendicular to an axis within the slope, planes
// are instead moved by the cone's largest spread in the scene.

// Whether the SIMD code, which computes in single precision, may accept hits by itself. If not, it
// only rules triangles out.
constexpr bool kHitsInSingle = kAcceptsSinglePrecision;

// Force-inline lambdas: an out-of-line call would spill the SIMD registers.
#define EXPHOTON_INLINE __attribute__((always_inline))

#include "accelerators/bvh/traverse/box_rays.inl"

// SIMD code compares with a slightly larger t, which covers the rounding of the computed distance.
inline Real Limit(Real t) { return t * (1 + Gamma(8)); }

#include "accelerators/bvh/traverse/block_ray.inl"

// Returns the triangle of a lane in the form that HitInDouble needs.
inline auto CornersOf(const BvhBlock& block, int lane) {
  return TriangleCorners<3 * kBvhWidth, kBvhWidth>{&block.vertices[0][0][lane]};
}

// Each node on a path leaves at most seven children on the stack. Push writes all eight lanes.
constexpr std::size_t kStackSize = std::size_t(kBvhMaxDepth) * (kBvhWidth - 1) + 2 * kBvhWidth;

// Visits the leaves along the ray: closest-hit rays from near to far, shadow rays in the blocking
// order. visit(child) tests a leaf and returns the largest t at which a hit still matters. A
// negative t ends the traversal.
template <bool kIsAny, class BoxRay, class Visit>
[[gnu::always_inline]] inline void Walk(const BvhArrays& arrays, const TraceRay& trace,
                                        const BoxRay& ray, const Visit& visit) {
  // The nearest child is on top of the stack. Bit i of `backward` says that the ray points down
  // axis i. A node stores the orders of four of the eight octants of directions; the opposite
  // octants read them backwards.
  const unsigned backward = ray.rows.backward;
  const bool isOpposite = !kIsAny && backward & 4;
  const PushOrder order(isOpposite);
  const std::size_t orderIndex = kIsAny       ? kBvhBlockingOrder
                                 : isOpposite ? 7 - backward
                                              : backward;
  const BvhLine* const lines = arrays.lines.data();
  BvhChild children[kStackSize];
  Real enters[kStackSize];
  std::size_t size = 0;
  BvhChild child(BvhChild::Kind::Node, 0);
  Real tMax = trace.ray.tMax;
  Real limit = Limit(tMax);
  for (;;) {
    if (child.IsNode()) {
      const BvhNode& node = child.Node(lines);
      const Crossings crossings = ray.Cross(node, Real8::All(limit));
      const std::size_t met = order.Push(node, orderIndex, crossings.first, crossings.last,
                                         children + size, enters + size, &child);
      if (met > 0) {
        size += met - 1;
        if (!kIsAny && size > 0) children[size - 1].Prefetch(lines);
        continue;
      }
    } else {
      tMax = visit(child);
      if (tMax < 0) return;
      if (!kIsAny) limit = Limit(tMax);
    }
    do {
      if (size == 0) return;
      --size;
    } while (!kIsAny && enters[size] > tMax);
    child = children[size];
  }
}

template <bool kIsAny, class Visit>
[[gnu::always_inline]] inline void WalkAs(const BvhArrays& arrays, const TraceRay& trace,
                                          const Visit& visit) {
  if (arrays.lines.empty()) return;
  const SlantedRay slanted(trace.ray);
  if (slanted.isSlanted) [[likely]] {
    Walk<kIsAny>(arrays, trace, slanted, visit);
  } else {
    Walk<kIsAny>(arrays, trace, AnyRay(trace.ray, trace.triangle.kz, arrays.bounds), visit);
  }
}

// Computes the distance of the nearest hit in double precision, by which hits are ordered. It is
// known already if low equals high.
[[gnu::noinline]] void FindDistance(const TriangleRay& ray, NearestHit* nearest) {
  if (nearest->low == nearest->high) return;
  const auto found = HitInDouble(ray, kInfinity, CornersOf(*nearest->block, nearest->lane));
  if (found) nearest->low = nearest->high = found->t;
}

// Returns whether a triangle lies behind the ray's origin, so that HitInDouble rejects it. The
// ray's line must cross the triangle, with this determinant. Most often the ray starts on the
// triangle.
inline bool IsBehind(const BvhBlock& block, int lane, const TriangleRay& ray, Real determinant) {
  return PlaneIsBehind(ray.o, CornersOf(block, lane), -double(determinant) * double(ray.sz));
}

// Tests a triangle in double precision and replaces *nearest if its hit wins.
[[gnu::noinline]] void TestInDouble(const BvhBlock& block, int lane, const TriangleRay& ray,
                              NearestHit* nearest) {
  const std::uint32_t id = block.ids[lane];
  // The same triangle may have been found in another leaf.
  if (id == nearest->hit.primitive && nearest->hit.instance == kNoId) return;
  const auto corners = CornersOf(block, lane);
  const auto found = HitInDouble(ray, nearest->high, corners);
  if (!found) return;
  FindDistance(ray, nearest);
  Hit ordered = nearest->hit;
  ordered.t = nearest->high;
  if (!Wins(found->t, kNoId, id, ordered)) return;
  // Hits are ordered by the distance in double precision. The reported one is in single precision
  // where possible, as in SIMD code, so that it does not depend on which code found it.
  const TriangleHit reported = HitInSingle(ray, corners).value_or(*found);
  nearest->hit = {reported.t, {reported.b1, reported.b2}, id, kNoId};
  nearest->low = nearest->high = found->t;
}

// Tests a block and replaces *nearest if one of its triangles wins.
[[gnu::always_inline]] inline void IntersectBlock(const BvhBlock& block, const BlockRay& blockRay,
                                                  const TriangleRay& ray, NearestHit* nearest) {
  const BlockHits hits = blockRay.Hits(block, nearest->high);
  if (hits.possible == 0) return;
  Real t[kBvhWidth], e1[kBvhWidth], e2[kBvhWidth], determinant[kBvhWidth];
  hits.t.StoreUnaligned(t), hits.e1.StoreUnaligned(e1), hits.e2.StoreUnaligned(e2);
  hits.determinant.StoreUnaligned(determinant);
  for (unsigned open = hits.possible; open != 0; open &= open - 1) {
    const int lane = std::countr_zero(open);
    const Real high = t[lane] * (1 + kSingleError);
    if ((hits.sure >> lane & 1) && high < nearest->low) {
      nearest->hit = {t[lane], {e1[lane] / determinant[lane], e2[lane] / determinant[lane]},
                      block.ids[lane], kNoId};
      nearest->low = t[lane] * (1 - kSingleError), nearest->high = high;
      nearest->block = &block, nearest->lane = lane;
    } else if (!(hits.crossed >> lane & 1) || !IsBehind(block, lane, ray, determinant[lane])) {
      TestInDouble(block, lane, ray, nearest);
    }
  }
}

// Returns whether the triangle blocks the ray, in double precision.
[[gnu::noinline]] bool BlocksInDouble(const BvhBlock& block, int lane, const TriangleRay& ray,
                                     Real tMax) {
  const auto found = HitInDouble(ray, tMax, CornersOf(block, lane));
  return found && found->t < tMax;
}

[[gnu::always_inline]] inline bool IsBlockedBy(const BvhBlock& block, const BlockRay& blockRay,
                                               const TraceRay& trace) {
  const Real tMax = trace.ray.tMax;
  const BlockHits hits = blockRay.Hits(block, tMax);
  if (hits.possible == 0) return false;
  if ((hits.sure & LessMask(hits.t, Real8::All(tMax * (1 - 2 * kSingleError)))) != 0) return true;
  Real determinant[kBvhWidth];
  hits.determinant.StoreUnaligned(determinant);
  for (unsigned open = hits.possible; open != 0; open &= open - 1) {
    const int lane = std::countr_zero(open);
    if ((hits.crossed >> lane & 1) && IsBehind(block, lane, trace.triangle, determinant[lane]))
      continue;
    if (BlocksInDouble(block, lane, trace.triangle, tMax)) return true;
  }
  return false;
}

Hit Intersect(const BvhArrays& arrays, const PrimitiveSet& primitives, const Ray& ray) {
  if (!IsWorthTracing(ray)) return {};
  const TraceRay trace(ray);
  const BlockRay blockRay(trace.triangle);
  NearestHit nearest(ray.tMax);
  WalkAs<false>(arrays, trace, [&](BvhChild leaf) EXPHOTON_INLINE {
    if (leaf.IsTriangles()) {
      IntersectBlock(leaf.Block(arrays.lines.data()), blockRay, trace.triangle, &nearest);
      return nearest.high;
    }
    FindDistance(trace.triangle, &nearest);
    const std::uint32_t* list = arrays.others.data() + leaf.Index();
    for (std::uint32_t i = 1; i <= list[0]; ++i)
      IntersectOther(primitives, list[i], trace, &nearest);
    return nearest.high;
  });
  return nearest.hit;
}

bool Occluded(const BvhArrays& arrays, const PrimitiveSet& primitives, const Ray& ray) {
  if (!IsWorthTracing(ray)) return false;
  const TraceRay trace(ray);
  const BlockRay blockRay(trace.triangle);
  bool isOccluded = false;
  WalkAs<true>(arrays, trace, [&](BvhChild leaf) EXPHOTON_INLINE {
    if (leaf.IsTriangles()) {
      isOccluded = IsBlockedBy(leaf.Block(arrays.lines.data()), blockRay, trace);
    } else {
      const std::uint32_t* list = arrays.others.data() + leaf.Index();
      for (std::uint32_t i = 1; i <= list[0] && !isOccluded; ++i)
        isOccluded = primitives.Occludes(list[i], trace);
    }
    return isOccluded ? Real(-1) : ray.tMax;
  });
  return isOccluded;
}

void MakeBlockRay(const TriangleRay& ray, BlockRayRoom* room) {
  static_assert(sizeof(BlockRay) <= sizeof(room->bytes));
  static_assert(alignof(BlockRay) <= alignof(BlockRayRoom));
  new (room->bytes) BlockRay(ray);
}

const BlockRay& BlockRayIn(const BlockRayRoom& room) {
  return *std::launder(reinterpret_cast<const BlockRay*>(room.bytes));
}

void IntersectBlocks(const BvhBlock* blocks, std::uint32_t count, const BlockRayRoom& room,
                     const TriangleRay& ray, NearestHit* nearest) {
  for (std::uint32_t i = 0; i < count; ++i)
    IntersectBlock(blocks[i], BlockRayIn(room), ray, nearest);
}

bool OccludedByBlocks(const BvhBlock* blocks, std::uint32_t count, const BlockRayRoom& room,
                      const TraceRay& trace) {
  for (std::uint32_t i = 0; i < count; ++i)
    if (IsBlockedBy(blocks[i], BlockRayIn(room), trace)) return true;
  return false;
}

#undef EXPHOTON_INLINE
