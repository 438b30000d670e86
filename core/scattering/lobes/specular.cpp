// SPDX-License-Identifier: BSD-2-Clause
// The delta lobes return the mirrored or the refracted direction with its coefficient.
#include "core/scattering/lobes/specular.h"

namespace exphoton {
namespace {

// Returns the mean of g over a hemisphere, weighted by 2 cos d(cos). The midpoint rule in the
// cosine resolves the steep part of Fresnel's equations at grazing angles.
template <class G>
auto HemisphericalMean(G&& g) {
  constexpr int kTerms = 32;
  decltype(g(Real(1))) sum{};
  for (int i = 0; i < kTerms; ++i) {
    const Real cosine = (Real(i) + Real(.5)) / kTerms;
    sum += g(cosine) * (2 * cosine / kTerms);
  }
  return sum;
}

}  // namespace

std::optional<BxdfSample> SpecularReflection::Sample(const Vector3& wo, Point2) const {
  if (wo.z == 0) return std::nullopt;
  const Spectrum weight = reflectance_ * fresnel_(wo.z);
  if (weight.IsBlack()) return std::nullopt;
  return BxdfSample{{-wo.x, -wo.y, wo.z}, weight, 1};
}

Spectrum SpecularReflection::Rho() const {
  return Clamp(reflectance_ * HemisphericalMean([&](Real cosine) { return fresnel_(cosine); }), 0,
               1);
}

std::optional<BxdfSample> SpecularTransmission::Sample(const Vector3& wo, Point2) const {
  if (wo.z == 0) return std::nullopt;
  if (etaOutside_ == etaInside_) return BxdfSample{-wo, transmittance_, 1};
  const bool isEntering = wo.z > 0;
  const Real eta = isEntering ? etaOutside_ / etaInside_ : etaInside_ / etaOutside_;
  const std::optional<Real> cosT = RefractedCosine(std::abs(wo.z), eta);
  if (!cosT) return std::nullopt;
  Spectrum weight = transmittance_ * (1 - FresnelDielectric(wo.z, etaOutside_, etaInside_));
  if (mode_ == TransportMode::Radiance) weight *= eta * eta;
  if (weight.IsBlack()) return std::nullopt;
  return BxdfSample{{-eta * wo.x, -eta * wo.y, isEntering ? -*cosT : *cosT}, weight, 1, eta};
}

Spectrum SpecularTransmission::Rho() const {
  return Clamp(transmittance_ * HemisphericalMean([&](Real cosine) {
                 return 1 - FresnelDielectric(cosine, etaOutside_, etaInside_);
               }),
               0, 1);
}

}  // namespace exphoton
