// SPDX-License-Identifier: BSD-2-Clause
// SlantedRay and AnyRay are rays in the form that slab tests need. This file is part of
// traverse.inl. Rounding never makes a ray miss a box that holds a hit, however far away the ray
// starts and however long its direction is.

// BoxRows gives the near and far rows of a node for the signs of a ray's direction.
struct BoxRows {
  std::size_t near[3], far[3];  // byte offsets in a node
  unsigned backward = 0;        // bit per axis: d is negative

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

// Crossings holds the t at which a ray enters and leaves the eight boxes of a node. The exit is
// limited to tMax. The ray meets a box if first <= last.
struct Crossings {
  Real8 first, last;

  template <class CrossNear, class CrossFar>
  static Crossings Of(const CrossNear& crossNear, const CrossFar& crossFar, Real8 tMax) {
    return {Max(Max(crossNear(0), crossNear(1)), Max(crossNear(2), Real8::All(Real(0)))),
            Min(Min(crossFar(0), crossFar(1)), Min(crossFar(2), tMax))};
  }
};

// The tests compare a direction with fractions of its largest component and divide by it. A largest
// component below this limit is too small for both; such a ray enters every box.
constexpr Real kLeastDirection = Real(1) / (std::uint64_t(1) << 50) / (std::uint64_t(1) << 50);

// SlantedRay is the fast form for a ray that is perpendicular to no axis. The ray crosses a plane
// at plane / d - o / d. The margin covers the rounding of o / d and the rounding of the hit.
struct SlantedRay {
  const BoxRows& rows;
  Real8 nearScale[3], nearShift[3], farScale[3], farShift[3];
  bool isSlanted;  // false: nothing else is set

  explicit SlantedRay(const Ray& ray) : rows(BoxRows::Of(ray.d)) {
    const Vector3 size = Abs(ray.d);
    const Real slope = kBvhMargin * MaxComponent(size);
    isSlanted = slope < std::min({size.x, size.y, size.z}) * Real(.25) &&
                slope >= kBvhMargin * kLeastDirection;
    if (!isSlanted) [[unlikely]]
      return;
    // With x = slope / |d|: 1 / (1 + x) >= 1 - x, and 1 / (1 - x) <= 1 + 2 x for x up to 1/2.
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

// AnyRay is the form for a ray of any direction.
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

  // Sets an axis to which the ray is nearly perpendicular. Up to the farthest hit, the ray strays
  // by less than 5/8 of the spread along this axis. A box with a possible hit therefore begins
  // behind one moved origin and ends ahead of the other, by at least 3/8 of the spread. This
  // distance divided by the slope is later than any hit. The slope has an inverse, because
  // |d[major]| is at least kLeastDirection.
  void SetPerpendicular(const Ray& ray, int axis, int major, const Bounds3& world) {
    constexpr double kMargin = double(kBvhMargin);
    // reach is the farthest that any hit can be along the major axis.
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
