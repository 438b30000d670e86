// SPDX-License-Identifier: BSD-2-Clause
// Spectrum is linear RGB with Rec. 709 / sRGB primaries. It holds radiance, power or reflectance;
// the variable's name says which.
#pragma once

#include "core/math/real.h"

namespace exphoton {

struct Spectrum {
  Real r = 0, g = 0, b = 0;

  constexpr Spectrum() = default;
  constexpr explicit Spectrum(Real grey) : r(grey), g(grey), b(grey) {}
  constexpr Spectrum(Real rr, Real gg, Real bb) : r(rr), g(gg), b(bb) {}

  static constexpr int kChannels = 3;
  constexpr Real operator[](int i) const { return i == 0 ? r : i == 1 ? g : b; }
  constexpr Real& operator[](int i) { return i == 0 ? r : i == 1 ? g : b; }

  constexpr Spectrum& operator+=(const Spectrum& s) {
    r += s.r;
    g += s.g;
    b += s.b;
    return *this;
  }
  constexpr Spectrum& operator-=(const Spectrum& s) {
    r -= s.r;
    g -= s.g;
    b -= s.b;
    return *this;
  }
  constexpr Spectrum& operator*=(const Spectrum& s) {
    r *= s.r;
    g *= s.g;
    b *= s.b;
    return *this;
  }
  constexpr Spectrum& operator*=(Real s) {
    r *= s;
    g *= s;
    b *= s;
    return *this;
  }
  constexpr Spectrum& operator/=(Real s) {
    r /= s;
    g /= s;
    b /= s;
    return *this;
  }
  friend constexpr bool operator==(const Spectrum&, const Spectrum&) = default;

  constexpr bool IsBlack() const { return r == 0 && g == 0 && b == 0; }
  // Returns the luminance, which is the Y of CIE XYZ for Rec. 709 primaries.
  constexpr Real Y() const { return Real(0.212671) * r + Real(0.715160) * g + Real(0.072169) * b; }
  constexpr Real MaxComponent() const { return std::max({r, g, b}); }
  constexpr Real MinComponent() const { return std::min({r, g, b}); }
  bool IsFinite() const { return std::isfinite(r) && std::isfinite(g) && std::isfinite(b); }
};

constexpr Spectrum operator+(Spectrum a, const Spectrum& b) { return a += b; }
constexpr Spectrum operator-(Spectrum a, const Spectrum& b) { return a -= b; }
constexpr Spectrum operator*(Spectrum a, const Spectrum& b) { return a *= b; }
constexpr Spectrum operator*(Spectrum a, Real s) { return a *= s; }
constexpr Spectrum operator*(Real s, Spectrum a) { return a *= s; }
constexpr Spectrum operator/(Spectrum a, Real s) { return a /= s; }
inline Spectrum Exp(const Spectrum& a) { return {std::exp(a.r), std::exp(a.g), std::exp(a.b)}; }
inline Spectrum Sqrt(const Spectrum& a) { return {SafeSqrt(a.r), SafeSqrt(a.g), SafeSqrt(a.b)}; }
constexpr Spectrum Clamp(const Spectrum& a, Real low, Real high) {
  return {std::clamp(a.r, low, high), std::clamp(a.g, low, high), std::clamp(a.b, low, high)};
}
constexpr Spectrum Lerp(Real t, const Spectrum& a, const Spectrum& b) {
  return a * (1 - t) + b * t;
}

}  // namespace exphoton
