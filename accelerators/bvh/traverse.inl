// SPDX-License-Identifier: BSD-2-Clause
// The traversal, written on what the including file defines for its vectors: Real8 (Load, All,
// + - *, Min, Max, LessMask), PresentMask, and PushOrder (puts the children that are met on the
// stack). Included into an unnamed namespace.
//
// Boxes are entered wherever rounding might have put a hit. A hit at t may be computed up to
// slope * t off the ray on each axis, slope = kBvhMargin * |d|: the ray is a thin cone, whose
// earliest crossing of a plane is (plane - o) / (|d_axis| + slope) and whose latest
// (plane - o) / (|d_axis| - slope). On an axis to which the ray is perpendicular within the slope,
// planes are moved by what the cone spreads to on its way through the scene instead.

// The ray as boxes see it.
struct BoxRay {
  Real8 nearOrigin[3], nearInverse[3], farOrigin[3], farInverse[3];
  std::size_t nearRow[3], farRow[3];  // bytes from the node's first
  unsigned backward = 0;              // a bit an axis

  BoxRay(const Ray& ray, int major, const Bounds3& world) {
    constexpr std::size_t kRow = sizeof(Real) * kBvhWidth;
    const Vector3 size = Abs(ray.d);
    const Real slope = kBvhMargin * size[major];
    for (int axis = 0; axis < 3; ++axis) {
      const bool isBackward = std::signbit(ray.d[axis]);
      backward |= unsigned(isBackward) << axis;
      nearRow[axis] = kRow * (2 * std::size_t(axis) + isBackward);
      farRow[axis] = kRow * (2 * std::size_t(axis) + !isBackward);
      // With x = slope / |d|: 1 / (1 + x) >= 1 - x, and 1 / (1 - x) <= 1 + 2 x up to 1/2.
      const Real d = ray.d[axis];
      const Real inverse = d == 0 ? std::copysign(kInfinity, d) : 1 / d;  // traps stay silent
      const Real x = slope * std::abs(inverse);
      nearOrigin[axis] = farOrigin[axis] = Real8::All(ray.o[axis]);
      nearInverse[axis] = Real8::All(inverse * (1 - x - Gamma(6)));
      farInverse[axis] = Real8::All(inverse * (1 + 2 * x + Gamma(6)));
      if (!(x < Real(.25))) [[unlikely]]
        SetPerpendicular(ray, axis, major, world);
    }
  }

  // For an axis to which the ray is (nearly) perpendicular: either never crosses a plane, or has
  // done so for good. It strays by less than 5/8 of the spread: what it may hit begins behind one
  // moved origin and ends ahead of the other. 0 * infinity leaves an axis out of Cross, which only
  // enters more boxes.
  [[gnu::noinline]] void SetPerpendicular(const Ray& ray, int axis, int major,
                                          const Bounds3& world) {
    constexpr double kMargin = double(kBvhMargin);
    // The farthest that any hit can be along the major axis.
    const double reach = std::max(std::abs(double(world.min[major]) - double(ray.o[major])),
                                  std::abs(double(world.max[major]) - double(ray.o[major])));
    const double spread = 8 * kMargin * reach;
    const bool isBackward = std::signbit(ray.d[axis]);
    nearInverse[axis] = farInverse[axis] = Real8::All(isBackward ? -kInfinity : kInfinity);
    const Real above = NextUp(Real(double(ray.o[axis]) + spread));
    const Real below = NextDown(Real(double(ray.o[axis]) - spread));
    nearOrigin[axis] = Real8::All(isBackward ? below : above);
    farOrigin[axis] = Real8::All(isBackward ? above : below);
  }

  // Where the ray enters the eight boxes of a node and where it leaves them, at most at tMax: a box
  // is met where first <= last.
  struct Crossings {
    Real8 first, last;
  };
  Crossings Cross(const BvhNode& node, Real8 tMax) const {
    const char* const rows = reinterpret_cast<const char*>(&node);
    const auto crossing = [&](std::size_t row, Real8 origin, Real8 inverse) {
      return (Real8::Load(reinterpret_cast<const Real*>(rows + row)) - origin) * inverse;
    };
    const auto crossNear = [&](int axis) {
      return crossing(nearRow[axis], nearOrigin[axis], nearInverse[axis]);
    };
    const auto crossFar = [&](int axis) {
      return crossing(farRow[axis], farOrigin[axis], farInverse[axis]);
    };
    return {Max(Max(crossNear(0), crossNear(1)), Max(crossNear(2), Real8::All(Real(0)))),
            Min(Min(crossFar(0), crossFar(1)), Min(crossFar(2), tMax))};
  }
};

// The ray as triangles see it: the shear of TriangleRay, eight wide.
struct BlockRay {
  Real8 ox, oy, oz, sx, sy, sz;
  int kx, ky, kz;

  explicit BlockRay(const TriangleRay& ray)
      : ox(Real8::All(ray.o[ray.kx])), oy(Real8::All(ray.o[ray.ky])),
        oz(Real8::All(ray.o[ray.kz])), sx(Real8::All(ray.sx)), sy(Real8::All(ray.sy)),
        sz(Real8::All(ray.sz)), kx(ray.kx), ky(ray.ky), kz(ray.kz) {}

  // The triangles of a block that may be hit by tMax. Edges as in MissesTriangle; and the distance
  // lies between those of the vertices.
  unsigned Candidates(const BvhBlock& block, Real8 tMax) const {
    Real8 x[3], y[3], t[3];
    for (int v = 0; v < 3; ++v) {
      const Real8 z = Real8::Load(block.vertices[v][kz]) - oz;
      x[v] = (Real8::Load(block.vertices[v][kx]) - ox) - sx * z;
      y[v] = (Real8::Load(block.vertices[v][ky]) - oy) - sy * z;
      t[v] = z * sz;
    }
    const Real8 u = x[2] * y[1] - y[2] * x[1], v = x[0] * y[2] - y[0] * x[2],
                w = x[1] * y[0] - y[1] * x[0];
    const Real8 zero = Real8::All(Real(0));
    const unsigned miss =
        LessMask(Min(Min(u, v), w), zero) & LessMask(zero, Max(Max(u, v), w));
    const unsigned far = LessMask(tMax, Min(Min(t[0], t[1]), t[2]));
    const unsigned behind = LessMask(Max(Max(t[0], t[1]), t[2]), zero);
    return PresentMask(block.ids) & ~(miss | far | behind);
  }
};

inline Point3 Vertex(const BvhBlock& block, int vertex, int lane) {
  const auto& rows = block.vertices[vertex];
  return {rows[0][lane], rows[1][lane], rows[2][lane]};
}

// Vectors compare with a little more than t: what rounding may add to a distance on the way.
inline Real8 Limit(Real t) { return Real8::All(t * (1 + Gamma(8))); }

// A way down leaves at most seven children waiting at each node; and all eight lanes are written.
constexpr std::size_t kStackSize = std::size_t(kBvhMaxDepth) * (kBvhWidth - 1) + 2 * kBvhWidth;

// Walks the tree from near to far or, where any hit will do, first to where one is likely.
// visit(child) deals with a leaf and returns the t beyond which nothing matters any more (ties at
// it do); a negative one ends the walk.
template <bool kIsAny, class Visit>
inline void Walk(const BvhArrays& arrays, const TraceRay& trace, const Visit& visit) {
  if (arrays.lines.empty()) return;
  const BoxRay ray(trace.ray, trace.triangle.kz, arrays.bounds);
  // The stack has the nearest on top; an order for the opposite direction is read backwards.
  const bool isOpposite = !kIsAny && ray.backward & 4;
  const PushOrder order(isOpposite);
  const std::size_t orderIndex = kIsAny ? kBvhBlockingOrder : (isOpposite ? 7 - ray.backward : ray.backward);
  BvhChild children[kStackSize];
  Real enters[kStackSize];
  children[0] = BvhChild(BvhChild::Kind::Node, 0);
  enters[0] = 0;
  std::size_t size = 1;
  Real tMax = trace.ray.tMax;
  Real8 limit = Limit(tMax);
  while (size > 0) {
    --size;
    if (!kIsAny && enters[size] > tMax) continue;
    const BvhChild child = children[size];
    if (child.IsNode()) {
      const BvhNode& node = arrays.Node(child);
      const BoxRay::Crossings crossings = ray.Cross(node, limit);
      size += order.Push(node, orderIndex, crossings.first, crossings.last, children + size,
                         enters + size);
    } else {
      tMax = visit(child);
      if (tMax < 0) return;
      if (!kIsAny) limit = Limit(tMax);
    }
  }
}

Hit Intersect(const BvhArrays& arrays, const PrimitiveSet& primitives, const Ray& ray) {
  Hit hit;
  if (!IsTraceable(ray)) return hit;
  hit.t = ray.tMax;
  const TraceRay trace(ray);
  const BlockRay blockRay(trace.triangle);
  Walk<false>(arrays, trace, [&](BvhChild leaf) {
    if (!leaf.IsTriangles()) {
      const std::uint32_t* list = arrays.others.data() + leaf.Index();
      for (std::uint32_t i = 1; i <= list[0]; ++i) primitives.Intersect(list[i], trace, &hit);
      return hit.t;
    }
    const BvhBlock& block = arrays.Block(leaf);
    unsigned candidates = blockRay.Candidates(block, Limit(hit.t));
    for (; candidates != 0; candidates &= candidates - 1) {
      const int lane = std::countr_zero(candidates);
      const auto found = DecideTriangle(trace.triangle, hit.t, Vertex(block, 0, lane),
                                        Vertex(block, 1, lane), Vertex(block, 2, lane));
      if (found && Wins(found->t, kNoId, block.ids[lane], hit))
        hit = {found->t, {found->b1, found->b2}, block.ids[lane], kNoId};
    }
    return hit.t;
  });
  return hit;
}

bool Occluded(const BvhArrays& arrays, const PrimitiveSet& primitives, const Ray& ray) {
  if (!IsTraceable(ray)) return false;
  const TraceRay trace(ray);
  const BlockRay blockRay(trace.triangle);
  const auto isBlocked = [&](BvhChild leaf) {
    if (!leaf.IsTriangles()) {
      const std::uint32_t* list = arrays.others.data() + leaf.Index();
      for (std::uint32_t i = 1; i <= list[0]; ++i)
        if (primitives.Occludes(list[i], trace)) return true;
      return false;
    }
    const BvhBlock& block = arrays.Block(leaf);
    unsigned candidates = blockRay.Candidates(block, Limit(ray.tMax));
    for (; candidates != 0; candidates &= candidates - 1) {
      const int lane = std::countr_zero(candidates);
      const auto found = DecideTriangle(trace.triangle, ray.tMax, Vertex(block, 0, lane),
                                        Vertex(block, 1, lane), Vertex(block, 2, lane));
      if (found && found->t < ray.tMax) return true;
    }
    return false;
  };
  bool isOccluded = false;
  Walk<true>(arrays, trace, [&](BvhChild leaf) {
    isOccluded = isBlocked(leaf);
    return isOccluded ? Real(-1) : ray.tMax;
  });
  return isOccluded;
}
