// SPDX-License-Identifier: BSD-2-Clause
// Bxdf: the interface of one scattering lobe, in the local frame where z is the shading normal.
// Directions are unit and leave the surface. Measures are stated at each method.
#pragma once

#include <optional>

#include "core/math/spectrum.h"
#include "core/math/vec.h"

namespace exphoton {

// Radiance: wo points to the eye, refracted radiance scales by the square of the relative index.
// Importance: wo points to where the photon came from; its power does not change at refraction.
enum class TransportMode { Radiance, Importance };

// A set of lobe kinds, one bit for each pair of side and sharpness.
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
  // f(wo,wi) |cos wi| / pdf: what a path's throughput is multiplied by. For a specular lobe the
  // delta's coefficient, its cosine already cancelled.
  Spectrum throughput;
  Real pdf = 0;  // per solid angle, > 0; for a specular lobe the probability of this choice
  Real eta = 1;  // of a specular transmission: index on wo's side over that on wi's side
};

// What a coat lets through at an angle, relative to its mean over all directions, weighted with the
// cosine (Ashikhmin and Shirley 2000).
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

  // Per steradian; 0 for a specular lobe and where wi is on the side the lobe does not serve.
  virtual Spectrum f(const Vector3& wo, const Vector3& wi) const = 0;
  // Density of Sample per solid angle; 0 for a specular lobe.
  virtual Real Pdf(const Vector3& wo, const Vector3& wi) const = 0;
  virtual std::optional<BxdfSample> Sample(const Vector3& wo, Point2 u) const = 0;
  // Hemispherical-hemispherical reflectance or transmittance, in [0,1] for physical coefficients:
  // closed form or a good approximation, never 0 for a lobe that is not black.
  virtual Spectrum Rho() const = 0;
  // Whether a diffuse lobe lies under a coat: f = Rho / pi a(cos wo) a(cos wi) with a =
  // CoatTransmission. Other diffuse lobes count as Lambert's where light is precomputed.
  virtual bool IsCoated() const { return false; }

 private:
  LobeSet lobe_;
};

}  // namespace exphoton
