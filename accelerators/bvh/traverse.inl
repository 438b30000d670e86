// SPDX-License-Identifier: BSD-2-Clause
// The traversal, written on what the including file defines for its vectors: Real8 (Load, All, +,
// -, *, MultiplyAdd, Min, Max, Abs, LessMask), Axes (All, +, -, *, /, Abs, AxesOf, AllOf),
// PresentMask, kFiltersPlanes (whether that pays), and PushOrder, whose Push finds the children
// where first <= last and returns how many: the first of the order is *next, and the stack has the
// others above what was there, the second on top. Included into an unnamed namespace.
//
// Boxes are entered wherever rounding might have put a hit. A hit at t may be computed up to
// slope * t off the ray on each axis, slope = kBvhMargin * |d|: the ray is a thin cone, whose
// earliest crossing of a plane is (plane - o) / (|d_axis| + slope) and whose latest
// (plane - o) / (|d_axis| - slope). On an axis to which the ray is perpendicular within the slope,
// planes are moved by what the cone spreads to on its way through the scene instead.

// Of lambdas: a call would put vectors into memory.
#define EXPHOTON_INLINE __attribute__((always_inline))

#include "accelerators/bvh/box_rays.inl"

// The ray as triangles see it: the shear of TriangleRay, eight wide.
struct BlockRay {
  Real8 ox, oy, oz, sx, sy, sz;
  int kx, ky, kz;
  bool isBackward;

  explicit BlockRay(const TriangleRay& ray)
      : ox(Real8::All(ray.ox)), oy(Real8::All(ray.oy)), oz(Real8::All(ray.oz)),
        sx(Real8::All(ray.sx)), sy(Real8::All(ray.sy)),
        sz(Real8::All(ray.sz)), kx(ray.kx), ky(ray.ky), kz(ray.kz), isBackward(ray.sz < 0) {}

  // The triangles of a block that may be hit by tMax. Edges as in MissesTriangle; and the distance
  // lies between those of the vertices. For the nearest hit also without those whose distance
  // DecideTriangle would surely find negative: foremost the one that the ray starts on.
  template <bool kIsAny>
  unsigned Candidates(const BvhBlock& block, Real8 tMax) const {
    Real8 x[3], y[3], z[3], t[3];
    for (int v = 0; v < 3; ++v) {
      z[v] = Real8::Load(block.vertices[v][kz]) - oz;
      x[v] = (Real8::Load(block.vertices[v][kx]) - ox) - sx * z[v];
      y[v] = (Real8::Load(block.vertices[v][ky]) - oy) - sy * z[v];
      t[v] = z[v] * sz;
    }
    const Real8 u = x[2] * y[1] - y[2] * x[1], v = x[0] * y[2] - y[0] * x[2],
                w = x[1] * y[0] - y[1] * x[0];
    const Real8 zero = Real8::All(Real(0));
    const unsigned negative = LessMask(Min(Min(u, v), w), zero),
                   positive = LessMask(zero, Max(Max(u, v), w));
    const unsigned far = LessMask(tMax, Min(Min(t[0], t[1]), t[2]));
    const unsigned behind = LessMask(Max(Max(t[0], t[1]), t[2]), zero);
    const unsigned candidates = PresentMask(block.ids) & ~((negative & positive) | far | behind);
    if (kIsAny || !kFiltersPlanes || candidates == 0) return candidates;
    const Real8 edges[3] = {u, v, w};
    // Twice the volume between origin and triangle, as DecideTriangle sums it, and the magnitudes
    // in it. A product here has two roundings in the edge, one in z and its own, and up to three
    // in the sum: off by less than Gamma(8) of the magnitudes, which as computed are at least
    // 1 - Gamma(8) of what they are. The rest of Gamma(12), of `tiny`, is more than the least
    // subnormal by which products are off that underflow. Where something overflows the bound is
    // infinite or NaN, and nothing is discarded. The sign of an edge is right or 0.
    const Real8 tiny = Real8::All(4 * std::numeric_limits<Real>::min());
    Real8 volume = zero, magnitude = tiny;
    for (int i = 0; i < 3; ++i) {
      const int next = (i + 1) % 3, last = (i + 2) % 3;
      const Real8 sum = Abs(x[last] * y[next]) + Abs(y[last] * x[next]) + tiny;
      volume = MultiplyAdd(edges[i], z[i], volume);
      magnitude = MultiplyAdd(sum, Abs(z[i]), magnitude);
    }
    const Real8 bound = magnitude * Real8::All(Gamma(12));
    const unsigned above = LessMask(bound, volume), below = LessMask(bound + volume, zero);
    return candidates & ~(isBackward ? (positive & above) | (negative & below)
                                     : (positive & below) | (negative & above));
  }
};

// The triangle of a lane, as DecideTriangle wants it.
inline auto CornersOf(const BvhBlock& block, int lane) {
  return TriangleCorners<3 * kBvhWidth, kBvhWidth>{&block.vertices[0][0][lane]};
}

// Vectors compare with a little more than t: what rounding may add to a distance on the way.
inline Real Limit(Real t) { return t * (1 + Gamma(8)); }

// A way down leaves at most seven children waiting at each node; and all eight lanes are written.
constexpr std::size_t kStackSize = std::size_t(kBvhMaxDepth) * (kBvhWidth - 1) + 2 * kBvhWidth;

// Walks the tree from near to far or, where any hit will do, first to where one is likely.
// visit(child, limit) deals with a leaf, of which nothing beyond the limit matters, and returns the
// t beyond which nothing matters any more (ties at it do); a negative one ends the walk.
template <bool kIsAny, class BoxRay, class Visit>
[[gnu::always_inline]] inline void Walk(const BvhArrays& arrays, const TraceRay& trace,
                                        const BoxRay& ray, const Visit& visit) {
  // The stack has the nearest on top; an order for the opposite direction is read backwards.
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
      tMax = visit(child, limit);
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

// Tests a block; replaces *hit where a triangle of it wins.
[[gnu::always_inline]] inline void IntersectBlock(const BvhBlock& block, const BlockRay& blockRay,
                                                  const TriangleRay& ray, Real limit, Hit* hit) {
  unsigned candidates = blockRay.Candidates<false>(block, Real8::All(limit));
  for (; candidates != 0; candidates &= candidates - 1) {
    const int lane = std::countr_zero(candidates);
    const auto found = DecideTriangle(ray, hit->t, CornersOf(block, lane));
    if (found && Wins(found->t, kNoId, block.ids[lane], *hit))
      *hit = {found->t, {found->b1, found->b2}, block.ids[lane], kNoId};
  }
}

[[gnu::always_inline]] inline bool IsBlockedBy(const BvhBlock& block, const BlockRay& blockRay,
                                               const TraceRay& trace, Real limit) {
  const Real tMax = trace.ray.tMax;
  unsigned candidates = blockRay.Candidates<true>(block, Real8::All(limit));
  for (; candidates != 0; candidates &= candidates - 1) {
    const int lane = std::countr_zero(candidates);
    const auto found = DecideTriangle(trace.triangle, tMax, CornersOf(block, lane));
    if (found && found->t < tMax) return true;
  }
  return false;
}

Hit Intersect(const BvhArrays& arrays, const PrimitiveSet& primitives, const Ray& ray) {
  Hit hit;
  if (!IsTraceable(ray)) return hit;
  hit.t = ray.tMax;
  const TraceRay trace(ray);
  const BlockRay blockRay(trace.triangle);
  WalkAs<false>(arrays, trace, [&](BvhChild leaf, Real limit) EXPHOTON_INLINE {
    if (leaf.IsTriangles()) {
      IntersectBlock(leaf.Block(arrays.lines.data()), blockRay, trace.triangle, limit, &hit);
      return hit.t;
    }
    const std::uint32_t* list = arrays.others.data() + leaf.Index();
    for (std::uint32_t i = 1; i <= list[0]; ++i) primitives.Intersect(list[i], trace, &hit);
    return hit.t;
  });
  return hit;
}

bool Occluded(const BvhArrays& arrays, const PrimitiveSet& primitives, const Ray& ray) {
  if (!IsTraceable(ray)) return false;
  const TraceRay trace(ray);
  const BlockRay blockRay(trace.triangle);
  bool isOccluded = false;
  WalkAs<true>(arrays, trace, [&](BvhChild leaf, Real limit) EXPHOTON_INLINE {
    if (leaf.IsTriangles()) {
      isOccluded = IsBlockedBy(leaf.Block(arrays.lines.data()), blockRay, trace, limit);
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
  static_assert(sizeof(BlockRay) <= sizeof(room->bytes) && alignof(BlockRay) <= alignof(BlockRayRoom));
  new (room->bytes) BlockRay(ray);
}

const BlockRay& BlockRayIn(const BlockRayRoom& room) {
  return *std::launder(reinterpret_cast<const BlockRay*>(room.bytes));
}

void IntersectBlocks(const BvhBlock* blocks, std::uint32_t count, const BlockRayRoom& room,
                     const TriangleRay& ray, Hit* hit) {
  for (std::uint32_t i = 0; i < count; ++i)
    IntersectBlock(blocks[i], BlockRayIn(room), ray, Limit(hit->t), hit);
}

bool OccludedByBlocks(const BvhBlock* blocks, std::uint32_t count, const BlockRayRoom& room,
                      const TraceRay& trace) {
  const Real limit = Limit(trace.ray.tMax);
  for (std::uint32_t i = 0; i < count; ++i)
    if (IsBlockedBy(blocks[i], BlockRayIn(room), trace, limit)) return true;
  return false;
}

#undef EXPHOTON_INLINE
