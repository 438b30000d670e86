// SPDX-License-Identifier: BSD-2-Clause
// Rays, surface points and the robust way from one to the other: a ray that leaves a surface starts
// outside the error bound of the point it leaves, so no comparison with a global epsilon is needed.
// Source: Pharr, Jakob and Humphreys 2016, section 3.9; docs/decisions/0003-geometry.md.
#pragma once

#include "core/math/vec.h"

namespace exphoton {

struct Ray {
  Point3 o;
  Vector3 d;              // not necessarily of unit length
  Real tMax = kInfinity;  // hits have 0 < t < tMax
  Real time = 0;

  Point3 operator()(Real t) const { return o + d * t; }
};

// A camera ray with its neighbours one pixel to the right (x) and below (y), for texture filtering.
struct RayDifferential : Ray {
  bool hasDifferentials = false;
  Point3 xOrigin, yOrigin;
  Vector3 xDirection, yDirection;

  RayDifferential() = default;
  RayDifferential(const Ray& ray) : Ray(ray) {}
};

// A point on a surface as computed, with the bound of its rounding error.
struct SurfacePoint {
  Point3 p;
  Vector3 pError;  // absolute, per axis: the true point lies in p +- pError
  Normal3 ng;      // unit geometric normal, on the outside as the scene file orients it;
                   // 0 for a point that is on no surface (pError 0 then)
  Real time = 0;   // at which it is there: surfaces may move
};

// The point just outside the error box of `point`, on the side of the surface that w leaves to.
Point3 OffsetRayOrigin(const SurfacePoint& point, const Vector3& w);

// The ray from `point` in direction w (any length), at the point's time; tMax infinite.
Ray SpawnRay(const SurfacePoint& point, const Vector3& w);

// Many rays from one point, each as SpawnRay makes it.
class RayFan {
 public:
  explicit RayFan(const SurfacePoint& point)
      : ng_(point.ng),
        front_(OffsetRayOrigin(point, point.ng)),
        back_(OffsetRayOrigin(point, -point.ng)),
        time_(point.time) {}

  Ray Towards(const Vector3& w) const {
    Ray ray;
    ray.o = Dot(w, ng_) < 0 ? back_ : front_;
    ray.d = w;
    ray.time = time_;
    return ray;
  }

 private:
  Normal3 ng_;
  Point3 front_, back_;
  Real time_;
};

// The segment between two surface points, both ends offset towards each other; occluders have
// 0 < t < tMax (1, less a few roundings). At the time of `from`.
Ray SpawnRayTo(const SurfacePoint& from, const SurfacePoint& to);

}  // namespace exphoton
