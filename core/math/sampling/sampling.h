// SPDX-License-Identifier: BSD-2-Clause
// These warps map the unit square or interval to directions, disks, cones and triangles. Each
// comment states the density. Sources: Shirley and Chiu 1997 (concentric disk), Pharr et al. 2016,
// chapter 13.
#pragma once

#include "core/math/vec.h"

namespace exphoton {

// Maps the unit square to the unit disk concentrically; density 1/pi per area.
inline Point2 SampleDisk(Point2 u) {
  const Real a = 2 * u.x - 1, b = 2 * u.y - 1;
  if (a == 0 && b == 0) return {0, 0};
  Real r, theta;
  if (std::abs(a) > std::abs(b)) {
    r = a;
    theta = (kPi / 4) * (b / a);
  } else {
    r = b;
    theta = (kPi / 2) - (kPi / 4) * (a / b);
  }
  return {r * std::cos(theta), r * std::sin(theta)};
}

// Samples a direction about +z with density cos(theta)/pi per solid angle. z > 0 always.
inline Vector3 SampleCosineHemisphere(Point2 u) {
  const Point2 d = SampleDisk(u);
  const Real z2 = 1 - d.x * d.x - d.y * d.y;
  // At the rim z^2 rounds to 0 or below. The smallest step of z^2 keeps the density positive.
  return {d.x, d.y, std::sqrt(std::max(z2, kMachineEpsilon))};
}
inline Real CosineHemispherePdf(Real cosTheta) { return cosTheta > 0 ? cosTheta * kInvPi : 0; }

// Samples the sphere uniformly; density 1/(4 pi) per solid angle.
inline Vector3 SampleUniformSphere(Point2 u) {
  const Real z = 1 - 2 * u.x;
  const Real r = SafeSqrt(4 * u.x * (1 - u.x));  // sqrt(1 - z^2) without cancellation
  const Real phi = 2 * kPi * u.y;
  return {r * std::cos(phi), r * std::sin(phi), z};
}
inline constexpr Real kUniformSpherePdf = kInv4Pi;

// Samples the hemisphere about +z uniformly; density 1/(2 pi) per solid angle.
inline Vector3 SampleUniformHemisphere(Point2 u) {
  const Real r = SafeSqrt(u.x * (2 - u.x));
  const Real phi = 2 * kPi * u.y;
  return {r * std::cos(phi), r * std::sin(phi), 1 - u.x};
}
inline constexpr Real kUniformHemispherePdf = kInv2Pi;

// Returns 1 - cos(angle), without cancellation for small angles.
inline Real OneMinusCos(Real angle) {
  const Real s = std::sin(angle / 2);
  return 2 * s * s;
}

// Samples the cone about +z uniformly. Its half-angle a is given by oneMinusCos = 1 - cos(a). The
// density is UniformConePdf(oneMinusCos) per solid angle.
inline Vector3 SampleUniformCone(Point2 u, Real oneMinusCos) {
  const Real t = u.x * oneMinusCos;  // 1 - cos(theta)
  const Real sinTheta = SafeSqrt(t * (2 - t));
  const Real phi = 2 * kPi * u.y;
  return {sinTheta * std::cos(phi), sinTheta * std::sin(phi), 1 - t};
}
inline Real UniformConePdf(Real oneMinusCos) { return kInv2Pi / oneMinusCos; }

struct PolarAngle {
  Real sine, cosine;
};
// Samples the polar angle whose cosine is (1 - u)^(1/n), n > 0 and u < 1. The density of directions
// about +z is then n/(2 pi) cos^(n-1). A sine computed from this cosine would have no digits near
// the axis. 1 - cosine has all of them.
inline PolarAngle SampleCosinePower(Real u, Real n) {
  const Real oneMinusCos = -std::expm1(std::log1p(-u) / n);
  return {SafeSqrt(oneMinusCos * (2 - oneMinusCos)), 1 - oneMinusCos};
}

// Returns barycentric coordinates (b1, b2) of a point uniform on a triangle.
inline Point2 SampleTriangle(Point2 u) {
  const Real s = std::sqrt(u.x);
  return {1 - s, u.y * s};
}

// Returns the direction with these polar angles about +z.
inline Vector3 SphericalDirection(Real sinTheta, Real cosTheta, Real phi) {
  return {sinTheta * std::cos(phi), sinTheta * std::sin(phi), cosTheta};
}
// Returns the azimuth of v about +z, in [0, 2 pi).
inline Real SphericalPhi(const Vector3& v) {
  const Real phi = std::atan2(v.y, v.x);
  return phi < 0 ? std::max(phi + 2 * kPi, Real(0)) : phi;
}
inline Real SphericalTheta(const Vector3& v) { return SafeAcos(v.z); }

}  // namespace exphoton
