// SPDX-License-Identifier: BSD-2-Clause
// The hit of a triangle in single precision, where that is accurate: most hits, at a fraction of
// what DecideTriangle costs (triangle_decide.h). Hits are ordered as by DecideTriangle; what is
// found of the first of them is told by this, wherever it can: the same bits from every accelerator
// and every width of vectors, which do the same operations in the same order.
//
// With x, y, z of the vertices as TriangleRay shears them, and X, Y, Z the largest |x|, |y|, |z|:
//   edge e = x y' - y x'; determinant = sum of e; volume = sum of e z; t = volume / determinant sz.
// All three edges must have one sign, which then is right. In units of u, half a Real's epsilon:
//   an edge is off by 2 * 2 X Y, the determinant by two roundings more: 4 * 6 X Y;
//   the volume by the edges' two, one in z, one of the product and two in the sum: 6 * 6 X Y Z.
// With volume > X Y Z / 16, and so determinant > X Y / 16, t is off by 60 * 16 u and the three
// roundings of quotient, product and what it is compared with: by less than Gamma(1024).
//
// Nor is the triangle's plane behind the ray, by PlaneIsAhead. That is about the volume of the true
// vertices, which a shear leaves as it is, but not its rounding: x and y are off by 4 u (X + Z) and
// 4 u (Y + Z), so the volume by less than 48 u (2 X Y + Z (X + Y)) Z. And its margin in double is,
// by the same norms, less than 2^-44 (X Y + Z (X + Y) + Z^2) Z. The terms of LargeVolume below are
// more than both.
// Source: Woop, Benthin and Wald 2013 (JCGT 2:1); Higham 2002, "Accuracy and Stability of Numerical
// Algorithms", chapter 3.
#pragma once

#include "core/geometry/triangle_decide.h"

namespace exphoton {

// A volume is large if it exceeds Z (of[0] X Y + Z (of[1] (X + Y) + of[2] Z)) + least.
struct LargeVolume {
  static constexpr Real kInDouble = Real(1) / (std::uint64_t(1) << 43);  // where Real is double
  static constexpr Real of[3] = {Real(1) / 16, std::max(Gamma(128), kInDouble),
                                 std::max(Gamma(128) / (1 << 20), kInDouble)};
  static constexpr Real least = Real(1) / (std::uint64_t(1) << 50) / (std::uint64_t(1) << 50);
};
// Distances further from 1, and rays with sz so far from it, may lose bits by underflow.
inline constexpr Real kLargestSingle = Real(1 << 30) * (1 << 30), kLeastSingle = 1 / kLargestSingle;
inline bool MayHitInSingle(const TriangleRay& ray) {
  constexpr Real kLargest = 1 << 30;
  return std::abs(ray.sz) < kLargest && std::abs(ray.sz) > 1 / kLargest;
}
// The relative difference from DecideTriangle's t is less than this.
inline constexpr Real kSingleError = Gamma(1024);

#if defined(EXPHOTON_TRAPS)
inline constexpr bool kTellsInSingle = false;  // what overflows is left alone, but only afterwards
#else
inline constexpr bool kTellsInSingle = true;
#endif

// None where double is needed to tell whether and where the triangle is hit.
template <class Corner>
[[gnu::always_inline]] inline std::optional<TriangleHit> HitInSingle(const TriangleRay& ray,
                                                                     const Corner& corner) {
  if (!kTellsInSingle || !MayHitInSingle(ray)) return std::nullopt;
  Real x[3], y[3], z[3], e[3];
  for (int v = 0; v < 3; ++v) {
    z[v] = corner(v, ray.kz) - ray.oz;
    x[v] = (corner(v, ray.kx) - ray.ox) - ray.sx * z[v];
    y[v] = (corner(v, ray.ky) - ray.oy) - ray.sy * z[v];
  }
  for (int v = 0; v < 3; ++v) {
    const int next = (v + 1) % 3, last = (v + 2) % 3;
    e[v] = x[last] * y[next] - y[last] * x[next];
  }
  const auto largest = [](const Real(&a)[3]) {
    return std::max({std::abs(a[0]), std::abs(a[1]), std::abs(a[2])});
  };
  const Real X = largest(x), Y = largest(y), Z = largest(z);
  const Real bound = Z * (LargeVolume::of[0] * (X * Y) +
                          Z * (LargeVolume::of[1] * (X + Y) + LargeVolume::of[2] * Z)) +
                     LargeVolume::least;
  const Real volume = (e[0] * z[0] + e[1] * z[1]) + e[2] * z[2];
  const Real determinant = (e[0] + e[1]) + e[2];
  const bool isLarge =
      std::min({e[0], e[1], e[2]}) * std::max({e[0], e[1], e[2]}) > 0 && std::abs(volume) > bound;
  if (!isLarge) return std::nullopt;
  const Real t = volume / determinant * ray.sz;
  if (!(t > kLeastSingle && t < kLargestSingle)) return std::nullopt;
  return TriangleHit{t, e[1] / determinant, e[2] / determinant};
}

}  // namespace exphoton
