// SPDX-License-Identifier: BSD-2-Clause
// Lambert samples ideal diffuse reflection in proportion to the cosine.
#include "core/scattering/lobes/lambert.h"

#include "core/math/sampling/sampling.h"
#include "core/scattering/lobes/local_frame.h"

namespace exphoton {

Spectrum Lambert::f(const Vector3& wo, const Vector3& wi) const {
  return SameHemisphere(wo, wi) ? f_ : Spectrum();
}

Real Lambert::Pdf(const Vector3& wo, const Vector3& wi) const {
  return SameHemisphere(wo, wi) ? std::abs(wi.z) * kInvPi : 0;
}

std::optional<BxdfSample> Lambert::Sample(const Vector3& wo, Point2 u) const {
  if (wo.z == 0) return std::nullopt;
  const Vector3 wi = OnSideOf(SampleCosineHemisphere(u), wo);
  return BxdfSample{wi, reflectance_, std::abs(wi.z) * kInvPi};
}

Spectrum Lambert::Rho() const { return reflectance_; }

}  // namespace exphoton
