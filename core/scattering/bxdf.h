// SPDX-License-Identifier: BSD-2-Clause
// Bxdf is the interface of one scattering lobe, in the local frame where z is the shading normal.
// Directions have unit length and point away from the surface. Each method states its measure.
#pragma once

#include <optional>

#include "core/math/spectrum.h"
#include "core/math/vec.h"

namespace exphoton {

// In Radiance mode, wo points to the eye, and refracted radiance scales by the square of the
// relative index. In Importance mode, wo points to the origin of the photon, and its power does not
// change at refraction.
enum class TransportMode { Radiance, Importance };

// LobeSet is a set of lobe kinds, with one bit for each pair of side and sharpness.
enum class LobeSet : unsigned {
  None = 0,
  DiffuseReflection = 1,
  GlossyReflection = 2,
  SpecularReflection = 4,
  DiffuseTransmission = 8,
  GlossyTransmission = 16,
  SpecularTransmission = 32,
  Reflection = 7,
  Transmission = 56,
  Diffuse = 9,
  Glossy = 18,
  Specular = 36,
  NonSpecular = 27,
  NonSpecularReflection = 3,
  NonSpecularTransmission = 24,
  All = 63,
};
constexpr LobeSet operator|(LobeSet a, LobeSet b) { return LobeSet(unsigned(a) | unsigned(b)); }
constexpr LobeSet operator&(LobeSet a, LobeSet b) { return LobeSet(unsigned(a) & unsigned(b)); }
constexpr bool Any(LobeSet set) { return set != LobeSet::None; }
constexpr bool Intersects(LobeSet a, LobeSet b) { return Any(a & b); }

struct BxdfSample {
  Vector3 wi;
  // This factor multiplies the path's throughput: f(wo,wi) |cos wi| / pdf. For a specular lobe it
  // is the coefficient of the delta, with the cosine already cancelled.
  Spectrum throughput;
  Real pdf = 0;  // per solid angle, > 0; for a specular lobe its probability
  Real eta = 1;  // of a specular transmission: index on wo's side / index on wi's side
};

// Returns the transmittance of a coat at an angle, relative to its cosine-weighted mean over all
// directions (Ashikhmin and Shirley 2000).
inline Real CoatTransmission(Real absCos) {
  const Real x = 1 - absCos / 2;
  return (1 - (x * x) * (x * x) * x) * (Real(28) / 23);
}

class Bxdf {
 public:
  explicit Bxdf(LobeSet lobe) : lobe_(lobe) {}
  virtual ~Bxdf() = default;

  LobeSet Lobe() const { return lobe_; }  // exactly one bit
  bool Matches(LobeSet mask) const { return Intersects(lobe_, mask); }

  // Returns the value per steradian. It is 0 for a specular lobe, and if wi is on the side to which
  // the lobe does not scatter.
  virtual Spectrum f(const Vector3& wo, const Vector3& wi) const = 0;
  // Returns the density of Sample per solid angle, or 0 for a specular lobe.
  virtual Real Pdf(const Vector3& wo, const Vector3& wi) const = 0;
  virtual std::optional<BxdfSample> Sample(const Vector3& wo, Point2 u) const = 0;
  // Returns a bound for each channel: f(wo,wi) |cos wi| <= bound * Pdf(wo,wi) for every wi, so that
  // no throughput of Sample(wo) is above it. nullopt: no bound is known.
  virtual std::optional<Spectrum> ThroughputBound(const Vector3& wo) const {
    (void)wo;
    return std::nullopt;
  }
  // Returns the hemispherical-hemispherical reflectance or transmittance, in [0,1] for physical
  // coefficients. It is a closed form or a good approximation, and never 0 for a lobe that is not
  // black.
  virtual Spectrum Rho() const = 0;
  // Returns whether f is Rho() / pi for all pairs of directions that the lobe connects.
  virtual bool IsLambertian() const { return false; }
  // Returns whether a diffuse lobe lies under a coat: f = Rho / pi a(cos wo) a(cos wi) with a =
  // CoatTransmission. Precomputed lighting treats other diffuse lobes as Lambertian.
  virtual bool IsCoated() const { return false; }

 private:
  LobeSet lobe_;
};

}  // namespace exphoton
