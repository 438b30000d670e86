// SPDX-License-Identifier: BSD-2-Clause
// Lambert is ideal diffuse reflection: f = R / pi.
#pragma once

#include "core/scattering/bxdf.h"

namespace exphoton {

class Lambert final : public Bxdf {
 public:
  explicit Lambert(const Spectrum& reflectance)
      : Bxdf(LobeSet::DiffuseReflection), reflectance_(reflectance), f_(reflectance * kInvPi) {}

  Spectrum f(const Vector3& wo, const Vector3& wi) const override;
  Real Pdf(const Vector3& wo, const Vector3& wi) const override;  // |cos wi| / pi
  std::optional<BxdfSample> Sample(const Vector3& wo, Point2 u) const override;
  std::optional<Spectrum> ThroughputBound(const Vector3&) const override { return reflectance_; }
  Spectrum Rho() const override;
  bool IsLambertian() const override { return true; }

 private:
  Spectrum reflectance_, f_;
};

}  // namespace exphoton
