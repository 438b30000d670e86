// SPDX-License-Identifier: BSD-2-Clause
// Part of traverse.inl: a ray as boxes see it. Whatever arithmetic does to rays from far away, with
// directions of any length, no box that holds a hit is passed by.

// Which way a ray goes through boxes.
struct BoxRows {
  std::size_t near[3], far[3];  // bytes from the first row of a node
  unsigned backward = 0;        // a bit an axis

  static const BoxRows& Of(const Vector3& d);
  explicit constexpr BoxRows(unsigned signs) : near(), far(), backward(signs) {
    constexpr std::size_t kRow = sizeof(Real) * kBvhWidth;
    for (int axis = 0; axis < 3; ++axis) {
      const bool isBackward = signs >> axis & 1;
      near[axis] = kRow * (2 * std::size_t(axis) + isBackward);
      far[axis] = kRow * (2 * std::size_t(axis) + !isBackward);
    }
  }
  static Real8 Load(const BvhNode& node, std::size_t row) {
    return Real8::Load(reinterpret_cast<const Real*>(reinterpret_cast<const char*>(&node) + row));
  }
};

constexpr BoxRows kBoxRows[8] = {BoxRows(0), BoxRows(1), BoxRows(2), BoxRows(3),
                                 BoxRows(4), BoxRows(5), BoxRows(6), BoxRows(7)};
inline const BoxRows& BoxRows::Of(const Vector3& d) {
  return kBoxRows[unsigned(std::signbit(d.x)) | unsigned(std::signbit(d.y)) << 1 |
                  unsigned(std::signbit(d.z)) << 2];
}

// Where a ray enters the eight boxes of a node, and where it leaves them, at most at tMax: a box is
// met where first <= last.
struct Crossings {
  Real8 first, last;

  template <class CrossNear, class CrossFar>
  static Crossings Of(const CrossNear& crossNear, const CrossFar& crossFar, Real8 tMax) {
    return {Max(Max(crossNear(0), crossNear(1)), Max(crossNear(2), Real8::All(Real(0)))),
            Min(Min(crossFar(0), crossFar(1)), Min(crossFar(2), tMax))};
  }
};

// Directions are compared with parts of their largest component, and divided by. Where it is less
// than this neither can be done; such rays look into every box.
constexpr Real kLeastDirection = Real(1) / (std::uint64_t(1) << 50) / (std::uint64_t(1) << 50);

// The ray as boxes see it, where it is perpendicular to no axis: planes are crossed at
// plane / d - o / d. What rounding of o / d may shift is added to what rounding of the hit may.
struct SlantedRay {
  const BoxRows& rows;
  Real8 nearScale[3], nearShift[3], farScale[3], farShift[3];
  bool isSlanted;  // whether it is; nothing else is set where not

  explicit SlantedRay(const Ray& ray) : rows(BoxRows::Of(ray.d)) {
    const Vector3 size = Abs(ray.d);
    const Real slope = kBvhMargin * MaxComponent(size);
    isSlanted = slope < std::min({size.x, size.y, size.z}) * Real(.25) &&
                slope >= kBvhMargin * kLeastDirection;
    if (!isSlanted) [[unlikely]]
      return;
    // With x = slope / |d|: 1 / (1 + x) >= 1 - x, and 1 / (1 - x) <= 1 + 2 x up to 1/2.
    const Axes inverse = Axes::All(1) / AxesOf(ray.d), x = Axes::All(slope) * Abs(inverse);
    const Axes nearest = inverse * (Axes::All(1 - Gamma(6)) - x);
    const Axes farthest = inverse * (Axes::All(1 + Gamma(6)) + (x + x));
    const Axes o = AxesOf(ray.o), rounding = Axes::All(Gamma(4));
    const Axes nearOffset = o * nearest, farOffset = o * farthest;
    const Axes nearMove = Axes::All(0) - nearOffset - Abs(nearOffset) * rounding;
    const Axes farMove = Abs(farOffset) * rounding - farOffset;
    for (int axis = 0; axis < 3; ++axis) {
      nearScale[axis] = AllOf(nearest, axis), nearShift[axis] = AllOf(nearMove, axis);
      farScale[axis] = AllOf(farthest, axis), farShift[axis] = AllOf(farMove, axis);
    }
  }

  Crossings Cross(const BvhNode& node, Real8 tMax) const {
    return Crossings::Of(
        [&](int axis) {
          return MultiplyAdd(BoxRows::Load(node, rows.near[axis]), nearScale[axis],
                             nearShift[axis]);
        },
        [&](int axis) {
          return MultiplyAdd(BoxRows::Load(node, rows.far[axis]), farScale[axis], farShift[axis]);
        },
        tMax);
  }
};

// The ray as boxes see it, whatever its direction.
struct AnyRay {
  const BoxRows& rows;
  Real8 nearOrigin[3], nearInverse[3], farOrigin[3], farInverse[3];

  AnyRay(const Ray& ray, int major, const Bounds3& world) : rows(BoxRows::Of(ray.d)) {
    const Real longest = MaxComponent(Abs(ray.d)), slope = kBvhMargin * longest;
    for (int axis = 0; axis < 3; ++axis) {
      const Real d = ray.d[axis];
      if (longest < kLeastDirection) {
        constexpr Real kLargest = std::numeric_limits<Real>::max();
        nearOrigin[axis] = Real8::All(kLargest), farOrigin[axis] = Real8::All(-kLargest);
        nearInverse[axis] = farInverse[axis] = Real8::All(1);
        continue;
      }
      if (!(slope < std::abs(d) * Real(.25))) {
        SetPerpendicular(ray, axis, major, world);
        continue;
      }
      const Real inverse = 1 / d, x = slope * std::abs(inverse);
      nearOrigin[axis] = farOrigin[axis] = Real8::All(ray.o[axis]);
      nearInverse[axis] = Real8::All(inverse * (1 - x - Gamma(6)));
      farInverse[axis] = Real8::All(inverse * (1 + 2 * x + Gamma(6)));
    }
  }

  // For an axis to which the ray is (nearly) perpendicular: either never crosses a plane, or has
  // done so for good. It strays by less than 5/8 of the spread: what it may hit begins behind one
  // moved origin and ends ahead of the other, by 3/8 at least. Divided by the slope that is later
  // than any hit. The slope has an inverse, as d[major] is no less than kLeastDirection.
  void SetPerpendicular(const Ray& ray, int axis, int major, const Bounds3& world) {
    constexpr double kMargin = double(kBvhMargin);
    // The farthest that any hit can be along the major axis.
    const double reach = std::max(std::abs(double(world.min[major]) - double(ray.o[major])),
                                  std::abs(double(world.max[major]) - double(ray.o[major])));
    const double spread = 8 * kMargin * reach;
    const bool isBackward = std::signbit(ray.d[axis]);
    const Real inverse = 1 / (kBvhMargin * std::abs(ray.d[major]));
    nearInverse[axis] = farInverse[axis] = Real8::All(isBackward ? -inverse : inverse);
    const Real above = NextUp(Real(double(ray.o[axis]) + spread));
    const Real below = NextDown(Real(double(ray.o[axis]) - spread));
    nearOrigin[axis] = Real8::All(isBackward ? below : above);
    farOrigin[axis] = Real8::All(isBackward ? above : below);
  }

  Crossings Cross(const BvhNode& node, Real8 tMax) const {
    return Crossings::Of(
        [&](int axis) {
          return (BoxRows::Load(node, rows.near[axis]) - nearOrigin[axis]) * nearInverse[axis];
        },
        [&](int axis) {
          return (BoxRows::Load(node, rows.far[axis]) - farOrigin[axis]) * farInverse[axis];
        },
        tMax);
  }
};
