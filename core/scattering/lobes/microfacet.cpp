// SPDX-License-Identifier: BSD-2-Clause
// Microfacet samples Torrance-Sparrow reflection by the half vector.
#include "core/scattering/lobes/microfacet.h"

#include "core/scattering/lobes/albedo_tables.h"
#include "core/scattering/lobes/local_frame.h"

namespace exphoton {
Spectrum Microfacet::f(const Vector3& wo, const Vector3& wi) const {
  const auto half = HalfVector::Of(wo, wi);
  if (!half) return {};
  const Real cosO = std::abs(wo.z), cosI = std::abs(wi.z), cosH = std::abs(half->h.z);
  if (!(cosO * cosI > 0)) return {};
  const Real g = std::min(Real(1), 2 * cosH * std::min(cosO, cosI) / half->cosine);
  const Spectrum value =
      reflectance_ * fresnel_(half->cosine) * (distribution_.D(cosH) * g / (4 * cosO * cosI));
  return value.IsFinite() ? value : Spectrum();
}

Real Microfacet::Pdf(const Vector3& wo, const Vector3& wi) const {
  const auto half = HalfVector::Of(wo, wi);
  if (!half) return 0;
  const Real pdf = distribution_.Pdf(std::abs(half->h.z)) / (4 * half->cosine);
  return std::isfinite(pdf) ? pdf : 0;
}

std::optional<BxdfSample> Microfacet::Sample(const Vector3& wo, Point2 u) const {
  const Vector3 h = OnSideOf(distribution_.Sample(u), wo);
  const Real oh = Dot(wo, h);
  if (!(oh > 0)) return std::nullopt;  // back of the facet
  const Vector3 wi = h * (2 * oh) - wo;
  if (!SameHemisphere(wo, wi)) return std::nullopt;
  const Real cosO = std::abs(wo.z), cosI = std::abs(wi.z), cosH = std::abs(h.z);
  const Real pdf = distribution_.Pdf(cosH) / (4 * oh);
  // In f cos_i / pdf, D cancels, and the rest is at most 2.
  const Real g = std::min(Real(1), 2 * cosH * std::min(cosO, cosI) / oh);
  const Spectrum weight = reflectance_ * fresnel_(oh) * (g * oh / (cosO * cosH));
  if (!(pdf > 0) || !std::isfinite(pdf) || !weight.IsFinite()) return std::nullopt;
  return BxdfSample{wi, weight, pdf};
}

// The factor of R F in Sample is g o.h / (cos_o cos_h). With g <= 2 cos_h cos_o / o.h it is at most
// 2. The half vector is farthest from wo where wi is on the opposite horizon: o.h^2 >= (1 - sin wo)
// / 2. F has no maximum between there and normal incidence.
std::optional<Spectrum> Microfacet::ThroughputBound(const Vector3& wo) const {
  const Real sine = std::min(std::sqrt(wo.x * wo.x + wo.y * wo.y), Real(1));
  const Spectrum normal = fresnel_(1), grazing = fresnel_(SafeSqrt((1 - sine) / 2));
  Spectrum bound;
  for (int c = 0; c < Spectrum::kChannels; ++c)
    bound[c] = 2 * reflectance_[c] * std::max(normal[c], grazing[c]);
  return bound;
}

Spectrum Microfacet::Rho() const {
  return Clamp(reflectance_ * MicrofacetAlbedo(distribution_.Exponent(), fresnel_), 0, 1);
}

Spectrum MicrofacetAlbedo(Real exponent, const Fresnel& fresnel) {
  const AlbedoRow row = AlbedoRow::Of(exponent);
  const auto& low = kMicrofacetAlbedo[row.index];
  const auto& high = kMicrofacetAlbedo[row.index + 1];
  Spectrum sum;
  for (std::size_t i = 0; i < low.size(); ++i) {
    const Real share = Lerp(row.fraction, Real(low[i]), Real(high[i]));
    sum += share * fresnel((Real(i) + Real(.5)) / Real(low.size()));
  }
  return sum;
}

}  // namespace exphoton
