// SPDX-License-Identifier: BSD-2-Clause
// Vec3d is a triple of doubles for the few geometric computations in which single precision
// cancels: differences of nearby points, plane equations, quadratics. Stored data stay in Real.
#pragma once

#include "core/math/vec.h"

namespace exphoton {

struct Vec3d {
  double x = 0, y = 0, z = 0;

  constexpr Vec3d() = default;
  constexpr Vec3d(double xx, double yy, double zz) : x(xx), y(yy), z(zz) {}
  constexpr explicit Vec3d(const Vec3& v) : x(v.x), y(v.y), z(v.z) {}

  constexpr double operator[](int i) const { return i == 0 ? x : i == 1 ? y : z; }
  Vec3 ToReal() const { return {Real(x), Real(y), Real(z)}; }
};

constexpr Vec3d operator+(const Vec3d& a, const Vec3d& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
constexpr Vec3d operator-(const Vec3d& a, const Vec3d& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
constexpr Vec3d operator*(const Vec3d& a, double s) { return {a.x * s, a.y * s, a.z * s}; }
constexpr Vec3d operator*(double s, const Vec3d& a) { return a * s; }
constexpr double Dot(const Vec3d& a, const Vec3d& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
constexpr Vec3d Cross(const Vec3d& a, const Vec3d& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline double Length(const Vec3d& a) { return std::sqrt(Dot(a, a)); }

// Returns a / |a|, or 0 if |a| is 0 or not finite. Products of two differences of float coordinates
// neither overflow nor underflow in double, so no scaling is needed.
inline Vec3d NormalizeOrZero(const Vec3d& a) {
  const double length = Length(a);
  if (!(length > 0) || !std::isfinite(length)) return {};
  return a * (1 / length);
}

}  // namespace exphoton
