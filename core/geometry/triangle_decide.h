// SPDX-License-Identifier: BSD-2-Clause
// The deciding part of the watertight ray-triangle test, inline for the loops of accelerators:
// what MissesTriangle (the cheap filter by edges) has let pass is decided here, in double.
// Source: Woop, Benthin and Wald 2013 (JCGT 2:1). Vertices are sheared so that the ray runs along
// z; the signs of the three edge functions then decide. They are exact for the sheared vertices: in
// single precision a sign is right or the value 0 (rounding is monotone), and where it is 0
// products in double decide, so that neighbours never both refuse a ray.
#pragma once

#include "core/geometry/triangle_mesh.h"
#include "core/geometry/vec3d.h"

namespace exphoton {

// Whether the plane of the triangle lies ahead of the ray's origin, beyond the rounding error of
// that decision. In double, from the true vertices: a ray that starts outside the error box of a
// point on this plane and leaves it is never sent back. `orientation` has the sign of the dot
// product of normal and ray.
inline bool PlaneIsAhead(const Point3& o, const Point3& p0, const Point3& p1, const Point3& p2,
                         double orientation) {
  const Vec3d a(p0);
  const Vec3d e1 = Vec3d(p1) - a, e2 = Vec3d(p2) - a, toPlane = a - Vec3d(o);
  const Vec3d n = Cross(e1, e2);
  const double distance = Dot(n, toPlane);
  constexpr double kUnit = std::numeric_limits<double>::epsilon();
  const double magnitude = (std::abs(e1.y * e2.z) + std::abs(e1.z * e2.y)) * std::abs(toPlane.x) +
                           (std::abs(e1.z * e2.x) + std::abs(e1.x * e2.z)) * std::abs(toPlane.y) +
                           (std::abs(e1.x * e2.y) + std::abs(e1.y * e2.x)) * std::abs(toPlane.z);
  const double ahead = orientation < 0 ? -distance : distance;
  return ahead > 8 * kUnit * magnitude;
}

// IntersectTriangle for a ray that MissesTriangle has not excluded.
inline std::optional<TriangleHit> DecideTriangle(const TriangleRay& ray, Real tMax,
                                                 const Point3& p0, const Point3& p1,
                                                 const Point3& p2) {
  struct Sheared {
    double x, y;
  };
  const int kx = ray.kx, ky = ray.ky, kz = ray.kz;
  const auto shear = [&](const Point3& p) -> Sheared {
    const Real z = p[kz] - ray.o[kz];
    const Real x = (p[kx] - ray.o[kx]) - ray.sx * z, y = (p[ky] - ray.o[ky]) - ray.sy * z;
    return {double(x), double(y)};
  };
  const Sheared a = shear(p0), b = shear(p1), c = shear(p2);
  const double du = c.x * b.y - c.y * b.x, dv = a.x * c.y - a.y * c.x, dw = b.x * a.y - b.y * a.x;
  if ((du < 0 || dv < 0 || dw < 0) && (du > 0 || dv > 0 || dw > 0)) return std::nullopt;
  const double determinant = du + dv + dw;
  if (!(std::abs(determinant) > 0)) return std::nullopt;  // edge-on, or NaN

  const double oz = double(ray.o[kz]), inverse = 1 / determinant;
  const double z =
      du * (double(p0[kz]) - oz) + dv * (double(p1[kz]) - oz) + dw * (double(p2[kz]) - oz);
  const Real t = Real(z * inverse * double(ray.sz));
  if (!(t > 0 && t <= tMax && t < kInfinity)) return std::nullopt;
  if (!PlaneIsAhead(ray.o, p0, p1, p2, -determinant * double(ray.sz))) return std::nullopt;
  return TriangleHit{t, Real(dv * inverse), Real(dw * inverse)};
}

}  // namespace exphoton
