// SPDX-License-Identifier: BSD-2-Clause
// Real is the floating-point type of geometry and transport. This file also has checked scalar
// helpers. A build with EXPHOTON_DOUBLE makes Real double, to separate errors of the algorithm from
// rounding. With EXPHOTON_LONG_DOUBLE only parts compile, for tests (tests/precision). Error
// bounds: Higham 2002, "Accuracy and Stability of Numerical Algorithms", section 3.1.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <type_traits>

namespace exphoton {

#if defined(EXPHOTON_LONG_DOUBLE)
using Real = long double;
#elif defined(EXPHOTON_DOUBLE)
using Real = double;
using RealBits = std::uint64_t;
#else
using Real = float;
using RealBits = std::uint32_t;
#endif

inline constexpr Real kInfinity = std::numeric_limits<Real>::infinity();
inline constexpr Real kMachineEpsilon = std::numeric_limits<Real>::epsilon() / 2;
inline constexpr Real kPi = Real(3.14159265358979323846L);
inline constexpr Real kInvPi = Real(0.31830988618379067154L);
inline constexpr Real kInv2Pi = Real(0.15915494309189533577L);
inline constexpr Real kInv4Pi = Real(0.07957747154594766788L);

// The largest Real below 1. Every uniform variate lies in [0, kOneMinusEpsilon].
inline constexpr Real kOneMinusEpsilon = 1 - kMachineEpsilon;

// Bounds the relative error of n successive roundings: n eps / (1 - n eps).
constexpr Real Gamma(int n) {
  return (Real(n) * kMachineEpsilon) / (1 - Real(n) * kMachineEpsilon);
}

constexpr Real Square(Real x) { return x * x; }
constexpr Real Lerp(Real t, Real a, Real b) { return (1 - t) * a + t * b; }
constexpr Real Radians(Real degrees) { return degrees * (kPi / 180); }
constexpr Real Degrees(Real radians) { return radians * (180 / kPi); }

// Returns the square root of max(x, 0), for values that only rounding can make negative.
inline Real SafeSqrt(Real x) { return std::sqrt(std::max(x, Real(0))); }
inline Real SafeAcos(Real x) { return std::acos(std::clamp(x, Real(-1), Real(1))); }
inline Real SafeAsin(Real x) { return std::asin(std::clamp(x, Real(-1), Real(1))); }

// Returns a / b, or `fallback` if b is 0 or the quotient is not finite.
inline Real SafeDivide(Real a, Real b, Real fallback) {
  if (b == 0) return fallback;
  const Real q = a / b;
  return std::isfinite(q) ? q : fallback;
}

// Returns the next representable value above x. +infinity stays; both zeros go to the smallest
// denormal.
inline Real NextUp(Real x) {
  if (std::isinf(x) && x > 0) return x;
  if (x == 0) return std::numeric_limits<Real>::denorm_min();
#if defined(EXPHOTON_LONG_DOUBLE)
  return std::nextafter(x, kInfinity);
#else
  const auto bits = std::bit_cast<RealBits>(x);
  return std::bit_cast<Real>(x > 0 ? bits + 1 : bits - 1);
#endif
}
inline Real NextDown(Real x) { return -NextUp(-x); }

}  // namespace exphoton
