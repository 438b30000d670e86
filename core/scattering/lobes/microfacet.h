// SPDX-License-Identifier: BSD-2-Clause
// Microfacet is glossy reflection by microfacets: f = R D G F / (4 cos_i cos_o), with Blinn's D and
// the G of V-grooves. Source: Torrance and Sparrow 1967, "Theory for Off-Specular Reflection from
// Roughened Surfaces".
#pragma once

#include "core/scattering/bxdf.h"
#include "core/scattering/lobes/blinn.h"
#include "core/scattering/lobes/fresnel.h"

namespace exphoton {

class Microfacet final : public Bxdf {
 public:
  Microfacet(const Spectrum& reflectance, const Fresnel& fresnel, Real exponent)
      : Bxdf(LobeSet::GlossyReflection),
        reflectance_(reflectance),
        fresnel_(fresnel),
        distribution_(exponent) {}

  Spectrum f(const Vector3& wo, const Vector3& wi) const override;
  Real Pdf(const Vector3& wo, const Vector3& wi) const override;  // D cos h / (4 wo.h)
  std::optional<BxdfSample> Sample(const Vector3& wo, Point2 u) const override;
  std::optional<Spectrum> ThroughputBound(const Vector3& wo) const override;
  Spectrum Rho() const override;

 private:
  Spectrum reflectance_;
  Fresnel fresnel_;
  BlinnDistribution distribution_;
};

// Returns the hemispherical-hemispherical reflectance for R = 1, from albedo_tables.h. The error is
// below 0.01.
Spectrum MicrofacetAlbedo(Real exponent, const Fresnel& fresnel);

}  // namespace exphoton
