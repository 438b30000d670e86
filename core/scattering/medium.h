// SPDX-License-Identifier: BSD-2-Clause
// Medium is the plugin interface of participating media, which absorb, scatter and emit light
// between surfaces within a region. Rays and points are in world space; coefficients are per unit
// of world length. Media may overlap: their coefficients add. Source: Chandrasekhar 1960,
// "Radiative Transfer", chapter 1.
#pragma once

#include <optional>

#include "core/geometry/ray.h"
#include "core/math/bounds.h"
#include "core/math/spectrum.h"

namespace exphoton {

// MediumPoint holds the coefficients at a point, all per unit of length.
struct MediumPoint {
  Spectrum absorption, scattering;
  Spectrum emission;  // radiance per unit of length
};

class Medium {
 public:
  virtual ~Medium() = default;

  // Returns a world-space box that contains the medium. It is finite.
  virtual Bounds3 Bounds() const = 0;
  // These return whether the coefficient may be above 0 at any point; false is a proof that it is
  // not.
  virtual bool Emits() const { return true; }
  virtual bool Scatters() const { return true; }
  virtual bool Absorbs() const { return true; }
  // Returns whether it provably changes no light.
  bool IsProvablyEmpty() const { return !Emits() && !Scatters() && !Absorbs(); }
  // Returns the part of 0 <= t <= ray.tMax that is inside, or nullopt if there is none.
  virtual std::optional<Interval> Overlap(const Ray& ray) const = 0;
  // Returns the coefficients at p. They are all 0 outside.
  virtual MediumPoint At(const Point3& p) const = 0;
  // Returns the integral of absorption and scattering over the part of the interval that is inside.
  // It is infinite if nothing gets through. It is exact up to rounding: there is no step length and
  // no random number.
  virtual Spectrum OpticalDepth(const Ray& ray, Interval part) const = 0;
  // Returns the density per solid angle of scattering light that arrives from wi into wo. Both have
  // unit length and point away from the point. The density integrates to 1.
  virtual Real Phase(const Vector3& wo, const Vector3& wi) const = 0;
};

// Henyey and Greenstein 1941: g > 0 scatters forwards, g = 0 is isotropic; -1 < g < 1. The base is
// 1
// + g^2 + 2 g Dot(wo, wi), which loses all digits at the peak if |g| is near 1. As (1 - |g|)^2 plus
// |g| times a squared length it keeps them.
inline Real HenyeyGreenstein(Real g, const Vector3& wo, const Vector3& wi) {
  const Real size = std::abs(g);
  const Vector3 fromPeak = g < 0 ? wo - wi : wo + wi;
  const Real base = (1 - size) * (1 - size) + size * LengthSquared(fromPeak);
  return kInv4Pi * (1 - g * g) / (base * std::sqrt(base));
}

}  // namespace exphoton
