// SPDX-License-Identifier: BSD-2-Clause
// Vec3 and Point2 are triples and pairs of Real. Point3, Vector3 and Normal3 are aliases of Vec3
// that state the meaning of a value. Transform has one method for each meaning.
#pragma once

#include "core/math/real.h"

namespace exphoton {

struct Vec3 {
  Real x = 0, y = 0, z = 0;

  constexpr Vec3() = default;
  constexpr Vec3(Real xx, Real yy, Real zz) : x(xx), y(yy), z(zz) {}
  constexpr explicit Vec3(Real v) : x(v), y(v), z(v) {}

  constexpr Real operator[](int i) const { return i == 0 ? x : i == 1 ? y : z; }
  constexpr Real& operator[](int i) { return i == 0 ? x : i == 1 ? y : z; }

  constexpr Vec3& operator+=(const Vec3& b) {
    x += b.x;
    y += b.y;
    z += b.z;
    return *this;
  }
  constexpr Vec3& operator-=(const Vec3& b) {
    x -= b.x;
    y -= b.y;
    z -= b.z;
    return *this;
  }
  constexpr Vec3& operator*=(Real s) {
    x *= s;
    y *= s;
    z *= s;
    return *this;
  }
  constexpr Vec3 operator-() const { return {-x, -y, -z}; }
  friend constexpr bool operator==(const Vec3&, const Vec3&) = default;
};

using Point3 = Vec3;   // a position
using Vector3 = Vec3;  // a direction or displacement
using Normal3 = Vec3;  // perpendicular to a surface: transforms by the inverse transpose

constexpr Vec3 operator+(Vec3 a, const Vec3& b) { return a += b; }
constexpr Vec3 operator-(Vec3 a, const Vec3& b) { return a -= b; }
constexpr Vec3 operator*(Vec3 a, Real s) { return a *= s; }
constexpr Vec3 operator*(Real s, Vec3 a) { return a *= s; }
constexpr Vec3 operator/(const Vec3& a, Real s) { return {a.x / s, a.y / s, a.z / s}; }

constexpr Real Dot(const Vec3& a, const Vec3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Real AbsDot(const Vec3& a, const Vec3& b) { return std::abs(Dot(a, b)); }

// Computes in double, so that nearly parallel arguments do not cancel.
constexpr Vec3 Cross(const Vec3& a, const Vec3& b) {
  const double ax = a.x, ay = a.y, az = a.z, bx = b.x, by = b.y, bz = b.z;
  return {Real(ay * bz - az * by), Real(az * bx - ax * bz), Real(ax * by - ay * bx)};
}

constexpr Real LengthSquared(const Vec3& a) { return Dot(a, a); }
inline Real Length(const Vec3& a) { return std::sqrt(LengthSquared(a)); }
constexpr Real DistanceSquared(const Vec3& a, const Vec3& b) { return LengthSquared(a - b); }
inline Real Distance(const Vec3& a, const Vec3& b) { return Length(a - b); }

inline bool IsFinite(const Vec3& a) {
  return std::isfinite(a.x) && std::isfinite(a.y) && std::isfinite(a.z);
}

// Returns a / |a|, or `fallback` if |a| is 0 or not finite. If the square would underflow or
// overflow, NormalizeExtremeOr first scales the vector by a power of two. Both computations give
// the same bits.
Vec3 NormalizeExtremeOr(const Vec3& a, const Vec3& fallback);
inline Vec3 NormalizeOr(const Vec3& a, const Vec3& fallback) {
  constexpr Real kSmall = Real(1e-20), kLarge = Real(1e30);
  const Real length2 = LengthSquared(a);
  if (length2 > kSmall && length2 < kLarge) return a / std::sqrt(length2);
  return NormalizeExtremeOr(a, fallback);
}
// Requires a vector of ordinary length: not 0, and its square neither underflows nor overflows.
inline Vec3 Normalize(const Vec3& a) { return a / Length(a); }

inline Vec3 Abs(const Vec3& a) { return {std::abs(a.x), std::abs(a.y), std::abs(a.z)}; }
inline Vec3 Min(const Vec3& a, const Vec3& b) {
  return {std::min(a.x, b.x), std::min(a.y, b.y), std::min(a.z, b.z)};
}
inline Vec3 Max(const Vec3& a, const Vec3& b) {
  return {std::max(a.x, b.x), std::max(a.y, b.y), std::max(a.z, b.z)};
}
constexpr Real MaxComponent(const Vec3& a) { return std::max({a.x, a.y, a.z}); }
constexpr int MaxDimension(const Vec3& a) {
  const bool isX = a.x > a.y;
  return (isX ? a.x : a.y) > a.z ? int(!isX) : 2;  // branch-free
}
// Returns n or -n, whichever is on v's side.
constexpr Vec3 FaceForward(const Vec3& n, const Vec3& v) { return Dot(n, v) < 0 ? -n : n; }

struct Point2 {
  Real x = 0, y = 0;
  constexpr Point2() = default;
  constexpr Point2(Real xx, Real yy) : x(xx), y(yy) {}
  constexpr Real operator[](int i) const { return i == 0 ? x : y; }
  constexpr Real& operator[](int i) { return i == 0 ? x : y; }
  friend constexpr bool operator==(const Point2&, const Point2&) = default;
};
constexpr Point2 operator+(Point2 a, Point2 b) { return {a.x + b.x, a.y + b.y}; }
constexpr Point2 operator-(Point2 a, Point2 b) { return {a.x - b.x, a.y - b.y}; }
constexpr Point2 operator*(Point2 a, Real s) { return {a.x * s, a.y * s}; }
constexpr Point2 operator*(Real s, Point2 a) { return a * s; }

struct Point2i {
  int x = 0, y = 0;
  friend constexpr bool operator==(const Point2i&, const Point2i&) = default;
};

// Frame is an orthonormal right-handed basis; z is the axis. FromZ needs no branch and loses no
// precision near -z. Source: Duff et al. 2017, "Building an Orthonormal Basis, Revisited" (JCGT
// 6:1).
struct Frame {
  Vector3 x, y, z;

  static Frame FromZ(const Vector3& n) {
    const Real sign = std::copysign(Real(1), n.z);
    const Real a = -1 / (sign + n.z);
    const Real b = n.x * n.y * a;
    return {Vector3(1 + sign * n.x * n.x * a, sign * b, -sign * n.x),
            Vector3(b, sign + n.y * n.y * a, -n.y), n};
  }
  constexpr Vector3 ToLocal(const Vector3& v) const { return {Dot(v, x), Dot(v, y), Dot(v, z)}; }
  constexpr Vector3 ToWorld(const Vector3& v) const { return x * v.x + y * v.y + z * v.z; }
};

}  // namespace exphoton
