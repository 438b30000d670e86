// SPDX-License-Identifier: BSD-2-Clause
// SpecularReflection and SpecularTransmission are ideal mirrors and smooth refracting boundaries.
// They are delta lobes: f and Pdf are 0, and only Sample returns light. The cosines of the deltas
// are cancelled analytically, so that no grazing direction divides by 0.
#pragma once

#include "core/scattering/bxdf.h"
#include "core/scattering/lobes/fresnel.h"

namespace exphoton {

// Returns the coefficient of a delta lobe, which is the throughput of its only sample; black if
// there is none.
inline Spectrum CoefficientOf(const Bxdf& delta, const Vector3& wo) {
  const auto sample = delta.Sample(wo, {});
  return sample ? sample->throughput : Spectrum();
}

// SpecularReflection reflects about the normal. The coefficient is R F(cos wo), with the signed
// cosine.
class SpecularReflection final : public Bxdf {
 public:
  SpecularReflection(const Spectrum& reflectance, const Fresnel& fresnel)
      : Bxdf(LobeSet::SpecularReflection), reflectance_(reflectance), fresnel_(fresnel) {}

  Spectrum f(const Vector3&, const Vector3&) const override { return {}; }
  Real Pdf(const Vector3&, const Vector3&) const override { return 0; }
  std::optional<BxdfSample> Sample(const Vector3& wo, Point2 u) const override;
  std::optional<Spectrum> ThroughputBound(const Vector3& wo) const override {
    return CoefficientOf(*this, wo);
  }
  Spectrum Rho() const override;

 private:
  Spectrum reflectance_;
  Fresnel fresnel_;
};

// SpecularTransmission refracts to the other side. The coefficient is T (1 - F). Radiance scales by
// the square of the relative index, so that L / eta^2 is constant along the refracted ray (Veach
// 1997, section 5.2). The power of photons does not change. With equal indices, the ray goes
// straight through.
class SpecularTransmission final : public Bxdf {
 public:
  SpecularTransmission(const Spectrum& transmittance, Real etaOutside, Real etaInside,
                       TransportMode mode)
      : Bxdf(LobeSet::SpecularTransmission),
        transmittance_(transmittance),
        etaOutside_(etaOutside),
        etaInside_(etaInside),
        mode_(mode) {}

  Spectrum f(const Vector3&, const Vector3&) const override { return {}; }
  Real Pdf(const Vector3&, const Vector3&) const override { return 0; }
  std::optional<BxdfSample> Sample(const Vector3& wo, Point2 u) const override;
  std::optional<Spectrum> ThroughputBound(const Vector3& wo) const override {
    return CoefficientOf(*this, wo);
  }
  Spectrum Rho() const override;

 private:
  Spectrum transmittance_;
  Real etaOutside_, etaInside_;
  TransportMode mode_;
};

}  // namespace exphoton
