// SPDX-License-Identifier: BSD-2-Clause
// This file defines rays, surface points and robust ray origins. A ray that leaves a surface starts
// outside the error bound of its point, so no comparison with a global epsilon is needed. Source:
// Pharr, Jakob and Humphreys 2016, section 3.9; docs/decisions/0003-geometry.md.
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

// RayDifferential is a camera ray with its neighbours one pixel to the right (x) and one pixel
// below (y), for texture filtering.
struct RayDifferential : Ray {
  bool hasDifferentials = false;
  Point3 xOrigin, yOrigin;
  Vector3 xDirection, yDirection;

  RayDifferential() = default;
  RayDifferential(const Ray& ray) : Ray(ray) {}
};

// SurfacePoint is a computed point on a surface, or in a medium, with the bound of its rounding
// error.
struct SurfacePoint {
  Point3 p;
  Vector3 pError;  // absolute, per axis: the true point lies in p +- pError
  Normal3 ng;      // unit geometric normal, on the outside as the scene file orients it;
                   // 0 for a point that is on no surface
  Real time = 0;   // time of the point: surfaces may move
};

// Returns the point just outside the error box of `point`, on the side of the surface to which w
// points.
Point3 OffsetRayOrigin(const SurfacePoint& point, const Vector3& w);

// Returns the ray from `point` in direction w (any length), at the point's time and with infinite
// tMax.
Ray SpawnRay(const SurfacePoint& point, const Vector3& w);

// RaySpawner spawns many rays from one point. Each ray equals the result of SpawnRay.
class RaySpawner {
 public:
  explicit RaySpawner(const SurfacePoint& point)
      : ng_(point.ng),
        front_(OffsetRayOrigin(point, point.ng)),
        back_(OffsetRayOrigin(point, -point.ng)),
        time_(point.time) {}

  Ray Spawn(const Vector3& w) const {
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

// Returns the segment between two surface points, with both ends offset towards each other.
// Occluders have 0 < t < tMax, where tMax is 1 less a few roundings. The ray has the time of
// `from`.
Ray SpawnRayTo(const SurfacePoint& from, const SurfacePoint& to);

}  // namespace exphoton
