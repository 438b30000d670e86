// SPDX-License-Identifier: BSD-2-Clause
// BlendedDiffuse and BlendedGloss are the two lobes of a diffuse surface under a glossy coat.
// Fresnel's law divides the light between them. Source: Ashikhmin and Shirley 2000, "An Anisotropic
// Phong BRDF Model", with the gloss normalised by e + 2.
#pragma once

#include "core/scattering/bxdf.h"

namespace exphoton {

// BlendedDiffuse is the diffuse base: f = Rho / pi a(cos wo) a(cos wi) with a = CoatTransmission.
class BlendedDiffuse final : public Bxdf {
 public:
  BlendedDiffuse(const Spectrum& diffuse, const Spectrum& gloss);

  Spectrum f(const Vector3& wo, const Vector3& wi) const override;
  Real Pdf(const Vector3& wo, const Vector3& wi) const override;  // |cos wi| / pi
  std::optional<BxdfSample> Sample(const Vector3& wo, Point2 u) const override;
  std::optional<Spectrum> ThroughputBound(const Vector3& wo) const override;
  Spectrum Rho() const override;  // exact
  bool IsCoated() const override { return true; }

 private:
  Spectrum rho_;
};

// BlendedGloss is the glossy coat.
class BlendedGloss final : public Bxdf {
 public:
  // The exponents are along the frame's x and y axes.
  BlendedGloss(const Spectrum& gloss, Real exponentX, Real exponentY);

  Spectrum f(const Vector3& wo, const Vector3& wi) const override;
  Real Pdf(const Vector3& wo, const Vector3& wi) const override;  // from the half vector's density
  std::optional<BxdfSample> Sample(const Vector3& wo, Point2 u) const override;
  std::optional<Spectrum> ThroughputBound(const Vector3& wo) const override;
  Spectrum Rho() const override;  // error up to 0.03 if the exponents differ

 private:
  Real PowH(const Vector3& h) const;  // cos h to the power of h's exponent

  Spectrum gloss_;
  Real ex_, ey_;
  Real normD_, normPdf_;
};

}  // namespace exphoton
