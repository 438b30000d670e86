// SPDX-License-Identifier: BSD-2-Clause
// The watertight ray-triangle test as a function: filter, then decision (triangle_decide.h).
#include "core/geometry/triangle_decide.h"

namespace exphoton {

TriangleRay::TriangleRay(const Ray& ray) : o(ray.o) {
  const Vector3 size = Abs(ray.d);
  kz = MaxDimension(size);
  kx = (kz + 1) % 3;
  ky = (kx + 1) % 3;
  const Real dz = ray.d[kz];
  sz = dz == 0 ? std::numeric_limits<Real>::quiet_NaN() : 1 / dz;
  sx = dz == 0 ? sz : ray.d[kx] / dz;
  sy = dz == 0 ? sz : ray.d[ky] / dz;
}

std::optional<TriangleHit> IntersectTriangle(const TriangleRay& ray, Real tMax, const Point3& p0,
                                             const Point3& p1, const Point3& p2) {
  if (MissesTriangle(ray, p0, p1, p2)) return std::nullopt;
  return DecideTriangle(ray, tMax, p0, p1, p2);
}

}  // namespace exphoton
