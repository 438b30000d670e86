// SPDX-License-Identifier: BSD-2-Clause
// HitInSingle computes a triangle hit in single precision where an error bound proves it safe. This
// covers most hits, at a fraction of the cost of HitInDouble (triangle_double.h). The order of
// hits is the order of HitInDouble; HitInSingle gives the reported values of the first hit if it
// can. All accelerators and SIMD targets report the same bits: they do the same operations in the
// same order.
#pragma once

#include "core/geometry/triangle_double.h"

namespace exphoton {

// Error bound. x, y, z are the vertices as sheared by TriangleRay; X, Y, Z are the largest |x|,
// |y|, |z|.
//   edge e = x y' - y x'; determinant = sum of e; volume = sum of e z; t = volume / determinant sz.
// All three edges must have one sign, which is then right. Errors in units of u, half a Real's
// epsilon:
//   an edge: 2 * 2 X Y; the determinant, with two more roundings: 4 * 6 X Y;
//   the volume, with the edges' two roundings, one in z, one of the product and two in the sum:
//   6 * 6 X Y Z.
// If volume > X Y Z / 16, then determinant > X Y / 16. The error of t is then 60 * 16 u plus the
// roundings of the quotient, of the product and of the t it is compared with. The sum is less than
// Gamma(1024).
//
// The triangle must also pass PlaneIsAhead, which tests the volume of the true vertices. An exact
// shear keeps this volume, but rounding changes it: x and y are off by 4 u (X + Z) and 4 u (Y + Z).
// The volume is a sum of six products, so it is off by less than 24 u (2 X Y + Z (X + Y)) Z, and
// terms in u^2. The error and the margin of PlaneIsAhead in double are, by the same norms, each
// less than 2^-44 (X Y + Z (X + Y) + Z^2) Z. The terms of LargeVolume exceed all errors.
// tests/proofs/triangle_*.gappa prove these bounds.
// Source: Woop, Benthin and Wald 2013 (JCGT 2:1); Higham 2002, "Accuracy and Stability of Numerical
// Algorithms", chapter 3.
//
// A volume is large if it exceeds Z (of[0] X Y + Z (of[1] (X + Y) + of[2] Z)) + least.
struct LargeVolume {
  static constexpr Real kInDouble = Real(1) / (std::uint64_t(1) << 43);  // where Real is double
  static constexpr Real of[3] = {Real(1) / 16, std::max(Gamma(128), kInDouble),
                                 std::max(Gamma(128) / (1 << 20), kInDouble)};
  static constexpr Real least = Real(1) / (std::uint64_t(1) << 50) / (std::uint64_t(1) << 50);
};
// Distances outside [kLeastSingle, kLargestSingle], and rays whose |sz| is outside [2^-30, 2^30],
// may lose bits by underflow.
inline constexpr Real kLargestSingle = Real(1 << 30) * (1 << 30), kLeastSingle = 1 / kLargestSingle;
inline bool MayHitInSingle(const TriangleRay& ray) {
  constexpr Real kLargest = 1 << 30;
  return std::abs(ray.sz) < kLargest && std::abs(ray.sz) > 1 / kLargest;
}
// The relative difference from HitInDouble's t is less than kSingleError.
inline constexpr Real kSingleError = Gamma(1024);
// If HitInSingle's t exceeds kBeyond tMax, HitInDouble's t exceeds tMax, whatever the rounding.
inline constexpr Real kBeyond = 1 + 2 * kSingleError;
// The error of the volume is less than this times X Y Z: 36 u, with room for rounding of the bound.
inline constexpr Real kVolumeError = 6 * Gamma(12);

#if defined(EXPHOTON_TRAPS)
inline constexpr bool kAcceptsSinglePrecision =
    false;  // rejects an overflow only after it would trap
#else
inline constexpr bool kAcceptsSinglePrecision = true;
#endif

// Returns nullopt if double precision is needed to decide whether and where the triangle is hit.
template <class Corner>
[[gnu::always_inline]] inline std::optional<TriangleHit> HitInSingle(const TriangleRay& ray,
                                                                     const Corner& corner) {
  if (!kAcceptsSinglePrecision || !MayHitInSingle(ray)) return std::nullopt;
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
