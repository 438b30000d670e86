// SPDX-License-Identifier: BSD-2-Clause
// Diffuse reflection under a glossy coat, exchanged by Fresnel's law: Ashikhmin and Shirley 2000,
// "An Anisotropic Phong BRDF Model", with the gloss normalised by e + 2.
#pragma once

#include "core/scattering/bxdf.h"

namespace exphoton {

class FresnelBlend final : public Bxdf {
 public:
  // Exponents along the frame's x and y.
  FresnelBlend(const Spectrum& diffuse, const Spectrum& gloss, Real exponentX, Real exponentY);

  Spectrum f(const Vector3& wo, const Vector3& wi) const override;
  // Half the cosine's density, half that of the half vector's reflection.
  Real Pdf(const Vector3& wo, const Vector3& wi) const override;
  std::optional<BxdfSample> Sample(const Vector3& wo, Point2 u) const override;
  Spectrum Rho() const override;  // the gloss to 0.03 where the exponents differ

 private:
  Real PowH(const Vector3& h) const;  // cos h to the direction's exponent

  Spectrum diffuse_;  // Kd (1 - Ks) 28 / (23 pi)
  Spectrum gloss_;
  Real ex_, ey_;
  Real normD_, normPdf_;
};

}  // namespace exphoton
