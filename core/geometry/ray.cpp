// SPDX-License-Identifier: BSD-2-Clause
// OffsetRayOrigin lets a ray leave a surface without hitting it again. It moves the origin along
// the normal until the plane through it clears the error box of the point. Then it moves each axis
// one representable step further. Every step scales exactly with powers of two.
#include "core/geometry/ray.h"

namespace exphoton {

Point3 OffsetRayOrigin(const SurfacePoint& point, const Vector3& w) {
  // `reach` is half the width of the error box along the normal.
  const Real reach = std::abs(point.ng.x) * point.pError.x + std::abs(point.ng.y) * point.pError.y +
                     std::abs(point.ng.z) * point.pError.z;
  Vector3 offset = point.ng * (reach * (1 + Gamma(8)));
  if (Dot(w, point.ng) < 0) offset = -offset;
  Point3 origin = point.p + offset;
  for (int axis = 0; axis < 3; ++axis) {
    if (offset[axis] == 0) continue;
    if (origin[axis] == 0) {
      // The next value would be a denormal, which does not scale with the scene.
      origin[axis] = offset[axis] * kMachineEpsilon;
    } else {
      origin[axis] = offset[axis] > 0 ? NextUp(origin[axis]) : NextDown(origin[axis]);
    }
  }
  return origin;
}

Ray SpawnRay(const SurfacePoint& point, const Vector3& w) {
  Ray ray;
  ray.o = OffsetRayOrigin(point, w);
  ray.d = w;
  ray.time = point.time;
  return ray;
}

Ray SpawnRayTo(const SurfacePoint& from, const SurfacePoint& to) {
  const Vector3 between = to.p - from.p;
  Ray ray;
  ray.o = OffsetRayOrigin(from, between);
  // The direction is rounded too. Enlarge the error of the far end by Gamma(4) of the distance.
  SurfacePoint end = to;
  end.pError += Abs(between) * Gamma(4);
  ray.d = OffsetRayOrigin(end, -between) - ray.o;
  ray.tMax = 1 - Gamma(4);
  ray.time = from.time;
  return ray;
}

}  // namespace exphoton
