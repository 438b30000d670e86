// SPDX-License-Identifier: BSD-2-Clause
// HitInDouble is the double-precision part of the watertight ray-triangle test, inline for the
// loops of accelerators. It tests the triangles that MissesTriangle (the cheap edge test) did not
// reject. Hits are ordered by the distance found here; triangle_single.h computes the reported
// values of the nearest hit.
#pragma once

#include "core/geometry/triangle_mesh.h"
#include "core/geometry/vec3d.h"

namespace exphoton {

// TriangleCorners reads the corners of a triangle. Coordinate `axis` of vertex v lies at
// first[v * kVertex + axis * kStep]. It is a class because a lambda of code for another SIMD target
// could not be inlined here.
template <int kVertex, int kStep>
struct TriangleCorners {
  const Real* first;
  Real operator()(int v, int axis) const { return first[v * kVertex + axis * kStep]; }
};

// PlaneVolume computes six times the volume between a point and a triangle, in double from the true
// vertices. Value has the sign of the dot product of the normal and the vector to the plane. A
// small multiple of the double epsilon times Magnitude bounds the rounding error of Value.
struct PlaneVolume {
  Vec3d e1, e2, toPlane;

  template <class Corner>
  [[gnu::always_inline]] PlaneVolume(const Point3& o, const Corner& corner) {
    const auto vertex = [&](int v) -> Vec3d {
      return {double(corner(v, 0)), double(corner(v, 1)), double(corner(v, 2))};
    };
    const Vec3d a = vertex(0);
    e1 = vertex(1) - a, e2 = vertex(2) - a, toPlane = a - Vec3d(o);
  }
  [[gnu::always_inline]] double Value() const { return Dot(Cross(e1, e2), toPlane); }
  [[gnu::always_inline]] double Magnitude() const {
    return (std::abs(e1.y * e2.z) + std::abs(e1.z * e2.y)) * std::abs(toPlane.x) +
           (std::abs(e1.z * e2.x) + std::abs(e1.x * e2.z)) * std::abs(toPlane.y) +
           (std::abs(e1.x * e2.y) + std::abs(e1.y * e2.x)) * std::abs(toPlane.z);
  }
};

// The error of PlaneVolume::Value is less than this times PlaneVolume::Magnitude
// (tests/proofs/plane_margin.gappa).
inline constexpr double kAheadMargin = 8 * std::numeric_limits<double>::epsilon();

// Returns whether the plane of the triangle lies ahead of the ray's origin by more than the
// rounding error of this test. A ray that starts outside the error box of a point on the plane and
// leaves the plane never hits it again. `orientation` has the sign of the dot product of normal and
// ray.
template <class Corner>
[[gnu::always_inline]] inline bool PlaneIsAhead(const Point3& o, const Corner& corner,
                                                double orientation) {
  const PlaneVolume volume(o, corner);
  const double ahead = orientation < 0 ? -volume.Value() : volume.Value();
  return ahead > kAheadMargin * volume.Magnitude();
}
// Returns whether the plane does not lie ahead of the origin, without a margin for rounding. If it
// is true, PlaneIsAhead is false. It rejects the triangle on which a ray starts.
template <class Corner>
[[gnu::always_inline]] inline bool PlaneIsBehind(const Point3& o, const Corner& corner,
                                                 double orientation) {
  const double value = PlaneVolume(o, corner).Value();
  return orientation < 0 ? value >= 0 : value <= 0;
}

// Returns the result of IntersectTriangle for a ray that MissesTriangle has not rejected. Vertices
// are sheared so that the ray runs along z; the signs of the three edge functions then decide. The
// signs are exact for the sheared vertices. In single precision (MissesTriangle) a sign is right or
// the value is 0, because rounding is monotone. The products in double used here are exact. Two
// neighbours therefore never both reject a ray. Source: Woop, Benthin and Wald 2013 (JCGT 2:1).
template <class Corner>
[[gnu::always_inline]] inline std::optional<TriangleHit> HitInDouble(const TriangleRay& ray,
                                                                     Real tMax,
                                                                     const Corner& corner) {
  struct Sheared {
    double x, y, z;  // z: translated, not scaled
  };
  const int kx = ray.kx, ky = ray.ky, kz = ray.kz;
  const auto shear = [&](int v) -> Sheared {
    const Real vertexZ = corner(v, kz), z = vertexZ - ray.oz;
    const Real x = (corner(v, kx) - ray.ox) - ray.sx * z, y = (corner(v, ky) - ray.oy) - ray.sy * z;
    return {double(x), double(y), double(vertexZ) - double(ray.oz)};
  };
  const Sheared a = shear(0), b = shear(1), c = shear(2);
  const double du = c.x * b.y - c.y * b.x, dv = a.x * c.y - a.y * c.x, dw = b.x * a.y - b.y * a.x;
  if ((du < 0 || dv < 0 || dw < 0) && (du > 0 || dv > 0 || dw > 0)) return std::nullopt;
  const double determinant = du + dv + dw;
  if (!(std::abs(determinant) > 0)) return std::nullopt;  // edge-on, or NaN

  const double inverse = 1 / determinant;
  const double z = du * a.z + dv * b.z + dw * c.z;
  const Real t = Real(z * inverse * double(ray.sz));
  if (!(t > 0 && t <= tMax && t < kInfinity)) return std::nullopt;
  if (!PlaneIsAhead(ray.o, corner, -determinant * double(ray.sz))) return std::nullopt;
  return TriangleHit{t, Real(dv * inverse), Real(dw * inverse)};
}

}  // namespace exphoton
