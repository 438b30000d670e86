// SPDX-License-Identifier: BSD-2-Clause
// The two lobes of a diffuse surface under a glossy coat, which share the light by Fresnel's law:
// Ashikhmin and Shirley 2000, "An Anisotropic Phong BRDF Model", with the gloss normalised by
// e + 2.
#pragma once

#include "core/scattering/bxdf.h"

namespace exphoton {

// The diffuse base: f = Rho / pi a(cos wo) a(cos wi), with a(c) = CoatTransmission(c).
class BlendedDiffuse final : public Bxdf {
 public:
  BlendedDiffuse(const Spectrum& diffuse, const Spectrum& gloss);

  Spectrum f(const Vector3& wo, const Vector3& wi) const override;
  Real Pdf(const Vector3& wo, const Vector3& wi) const override;  // |cos wi| / pi
  std::optional<BxdfSample> Sample(const Vector3& wo, Point2 u) const override;
  Spectrum Rho() const override;  // exact
  bool IsCoated() const override { return true; }

 private:
  Spectrum rho_;
};

// The coat.
class BlendedGloss final : public Bxdf {
 public:
  // Exponents along the frame's x and y.
  BlendedGloss(const Spectrum& gloss, Real exponentX, Real exponentY);

  Spectrum f(const Vector3& wo, const Vector3& wi) const override;
  Real Pdf(const Vector3& wo, const Vector3& wi) const override;  // of the half vector's reflection
  std::optional<BxdfSample> Sample(const Vector3& wo, Point2 u) const override;
  Spectrum Rho() const override;  // to 0.03 where the exponents differ

 private:
  Real PowH(const Vector3& h) const;  // cos h to the direction's exponent

  Spectrum gloss_;
  Real ex_, ey_;
  Real normD_, normPdf_;
};

}  // namespace exphoton
