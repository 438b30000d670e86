// SPDX-License-Identifier: BSD-2-Clause
// OrenNayar evaluates Oren and Nayar's diffuse reflection without trigonometric functions and
// samples it in proportion to the cosine.
#include "core/scattering/lobes/oren_nayar.h"

#include "core/math/sampling/sampling.h"
#include "core/scattering/lobes/local_frame.h"

namespace exphoton {

OrenNayar::OrenNayar(const Spectrum& reflectance, Real sigma)
    : Bxdf(LobeSet::DiffuseReflection), reflectance_(reflectance) {
  const Real sigma2 = sigma * sigma;
  a_ = 1 - sigma2 / (2 * (sigma2 + Real(.33)));
  b_ = Real(.45) * sigma2 / (sigma2 + Real(.09));
}

// The model's term is cos(dphi) sin(alpha) tan(beta), with alpha the larger and beta the smaller
// polar angle. The two sines cancel against the normalisation of the azimuths. This leaves
// (wi.xy . wo.xy) / max(cosines).
Spectrum OrenNayar::f(const Vector3& wo, const Vector3& wi) const {
  if (!SameHemisphere(wo, wi)) return {};
  const Real azimuth = std::max(wo.x * wi.x + wo.y * wi.y, Real(0));
  const Real rough = azimuth / std::max(std::abs(wo.z), std::abs(wi.z));
  const Spectrum value = reflectance_ * (kInvPi * (a_ + b_ * rough));
  return value.IsFinite() ? value : Spectrum();  // not finite if both cosines are denormal
}

Real OrenNayar::Pdf(const Vector3& wo, const Vector3& wi) const {
  return SameHemisphere(wo, wi) ? std::abs(wi.z) * kInvPi : 0;
}

std::optional<BxdfSample> OrenNayar::Sample(const Vector3& wo, Point2 u) const {
  if (wo.z == 0) return std::nullopt;
  const Vector3 wi = OnSideOf(SampleCosineHemisphere(u), wo);
  return BxdfSample{wi, f(wo, wi) * kPi, std::abs(wi.z) * kInvPi};
}

// The term is at most sin(wi) tan(wo) where wo has the larger cosine, and at most sin(wo) tan(wi)
// <= tan(wo) where wi has it. Neither is above the tangent of wo.
std::optional<Spectrum> OrenNayar::ThroughputBound(const Vector3& wo) const {
  const Real tangent = std::sqrt(wo.x * wo.x + wo.y * wo.y) / std::abs(wo.z);
  const Spectrum bound = reflectance_ * (a_ + b_ * tangent);
  if (!bound.IsFinite()) return std::nullopt;
  return bound;
}

// The mean of max(0, cos dphi) sin(alpha) tan(beta) over both hemispheres, weighted by cosines, is
// 2/3 - 64/(45 pi).
Spectrum OrenNayar::Rho() const {
  constexpr Real kMean = Real(0.21395911);
  return reflectance_ * (a_ + b_ * kMean);
}

}  // namespace exphoton
