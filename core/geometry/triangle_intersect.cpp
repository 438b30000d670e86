// SPDX-License-Identifier: BSD-2-Clause
// IntersectTriangle is the watertight ray-triangle test as a function: first the edge test, then
// the exact test (triangle_double.h).
#include "core/geometry/triangle_double.h"

namespace exphoton {

std::optional<TriangleHit> IntersectTriangle(const TriangleRay& ray, Real tMax, const Point3& p0,
                                             const Point3& p1, const Point3& p2) {
  if (MissesTriangle(ray, p0, p1, p2)) return std::nullopt;
  const Real corners[9] = {p0.x, p0.y, p0.z, p1.x, p1.y, p1.z, p2.x, p2.y, p2.z};
  return HitInDouble(ray, tMax, TriangleCorners<3, 1>{corners});
}

}  // namespace exphoton
