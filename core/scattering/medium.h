// SPDX-License-Identifier: BSD-2-Clause
// Medium: the interface of participating media (plugins): what absorbs, scatters and emits light
// between surfaces, within a region. Rays and points are in world space; coefficients are per unit
// of world length. Several media may overlap: their coefficients add.
// Source: Chandrasekhar 1960, "Radiative Transfer", chapter 1.
#pragma once

#include <optional>

#include "core/geometry/ray.h"
#include "core/math/bounds.h"
#include "core/math/spectrum.h"

namespace exphoton {

// Coefficients at a point, all per unit of length.
struct MediumPoint {
  Spectrum absorption, scattering;
  Spectrum emission;  // radiance per unit of length
};

class Medium {
 public:
  virtual ~Medium() = default;

  // World-space box that contains the medium; finite.
  virtual Bounds3 Bounds() const = 0;
  // Whether the coefficient may be above 0 at any point; false is a proof that it is not.
  virtual bool Emits() const { return true; }
  virtual bool Scatters() const { return true; }
  // The part of 0 <= t <= ray.tMax that is inside; nullopt: none.
  virtual std::optional<Interval> Overlap(const Ray& ray) const = 0;
  // All 0 outside.
  virtual MediumPoint At(const Point3& p) const = 0;
  // Integral of absorption and scattering over the part of the interval that is inside; infinite
  // where nothing gets through. Exact to rounding: no step length, no random number.
  virtual Spectrum OpticalDepth(const Ray& ray, Interval part) const = 0;
  // Density per solid angle of scattering light that arrives from wi into wo; both unit, away from
  // the point. Integrates to 1.
  virtual Real Phase(const Vector3& wo, const Vector3& wi) const = 0;
};

// Henyey and Greenstein 1941: g > 0 scatters forwards, 0 alike everywhere; -1 < g < 1.
inline Real HenyeyGreenstein(Real g, const Vector3& wo, const Vector3& wi) {
  const Real base = 1 + g * g + 2 * g * Dot(wo, wi);
  return kInv4Pi * (1 - g * g) / (base * std::sqrt(base));
}

}  // namespace exphoton
