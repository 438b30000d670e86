// SPDX-License-Identifier: BSD-2-Clause
// OrenNayar is rough diffuse reflection: the qualitative model of Oren and Nayar 1994,
// "Generalization of Lambert's Reflectance Model", eq. 30. sigma is the standard deviation of the
// facets' slope angle.
#pragma once

#include "core/scattering/bxdf.h"

namespace exphoton {

class OrenNayar final : public Bxdf {
 public:
  OrenNayar(const Spectrum& reflectance, Real sigma);  // sigma in radians

  Spectrum f(const Vector3& wo, const Vector3& wi) const override;
  Real Pdf(const Vector3& wo, const Vector3& wi) const override;  // |cos wi| / pi
  std::optional<BxdfSample> Sample(const Vector3& wo, Point2 u) const override;
  std::optional<Spectrum> ThroughputBound(const Vector3& wo) const override;
  Spectrum Rho() const override;

 private:
  Spectrum reflectance_;
  Real a_, b_;
};

}  // namespace exphoton
