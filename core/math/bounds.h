// SPDX-License-Identifier: BSD-2-Clause
// Bounds3 is an axis-aligned bounding box, and IntersectBox is the slab test that accelerators
// share. Far distances are enlarged after Ize 2013, "Robust BVH Ray Traversal" (JCGT 2:2), so that
// rounding never misses a box. Zero direction components are decided by comparison.
#pragma once

#include <optional>

#include "core/math/vec.h"

namespace exphoton {

struct Bounds3 {
  Point3 min{kInfinity, kInfinity, kInfinity};
  Point3 max{-kInfinity, -kInfinity, -kInfinity};

  constexpr Bounds3() = default;  // empty: holds no point
  constexpr explicit Bounds3(const Point3& p) : min(p), max(p) {}
  Bounds3(const Point3& a, const Point3& b) : min(Min(a, b)), max(Max(a, b)) {}

  bool IsEmpty() const { return !(min.x <= max.x && min.y <= max.y && min.z <= max.z); }
  void Extend(const Point3& p) {
    min = Min(min, p);
    max = Max(max, p);
  }
  void Extend(const Bounds3& b) {
    min = Min(min, b.min);
    max = Max(max, b.max);
  }
  Vector3 Diagonal() const { return max - min; }
  int LongestAxis() const {  // the first of equal axes
    const Vector3 d = Diagonal();
    return d.x >= d.y && d.x >= d.z ? 0 : d.y >= d.z ? 1 : 2;
  }
  Point3 Center() const { return min * Real(.5) + max * Real(.5); }
  Real SurfaceArea() const {
    if (IsEmpty()) return 0;
    const Vector3 d = Diagonal();
    return 2 * (d.x * d.y + d.y * d.z + d.z * d.x);
  }
  bool Contains(const Point3& p) const {
    return p.x >= min.x && p.x <= max.x && p.y >= min.y && p.y <= max.y && p.z >= min.z &&
           p.z <= max.z;
  }
  Point3 Corner(int i) const {
    return {i & 1 ? max.x : min.x, i & 2 ? max.y : min.y, i & 4 ? max.z : min.z};
  }
};

struct Sphere3 {
  Point3 center;
  Real radius = 0;  // 0 for an empty world
};

// Returns the sphere around the box, not the smallest sphere around its contents.
inline Sphere3 BoundingSphere(const Bounds3& b) {
  if (b.IsEmpty()) return {};
  return {b.Center(), Distance(b.Center(), b.max)};
}

struct Interval {
  Real min, max;
};

// Returns the part of [0, tMax] where the ray o + t d is inside the box, conservatively enlarged. A
// NaN in the ray gives nullopt.
inline std::optional<Interval> IntersectBox(const Bounds3& box, const Point3& o, const Vector3& d,
                                            Real tMax) {
  Real t0 = 0, t1 = tMax;
  for (int axis = 0; axis < 3; ++axis) {
    if (d[axis] == 0) {  // also -0
      if (!(o[axis] >= box.min[axis] && o[axis] <= box.max[axis])) return std::nullopt;
      continue;
    }
    const Real inverse = 1 / d[axis];
    Real tNear = (box.min[axis] - o[axis]) * inverse;
    Real tFar = (box.max[axis] - o[axis]) * inverse;
    if (inverse < 0) std::swap(tNear, tFar);
    tFar *= 1 + 2 * Gamma(3);
    if (tNear > t0) t0 = tNear;
    if (!(tFar >= t1)) t1 = tFar;  // a NaN rejects the box
    if (!(t0 <= t1)) return std::nullopt;
  }
  if (!(t0 <= t1)) return std::nullopt;
  return Interval{t0, t1};
}

}  // namespace exphoton
