// SPDX-License-Identifier: BSD-2-Clause
// Ideal mirrors and smooth refracting boundaries: delta lobes, whose f and Pdf are 0 and which
// exist only for Sample. The deltas' cosines are cancelled on paper, so that no grazing direction
// divides by 0.
#pragma once

#include "core/scattering/bxdf.h"
#include "core/scattering/lobes/fresnel.h"

namespace exphoton {

// Reflects about the normal; coefficient R F(cos wo), the cosine with its sign.
class SpecularReflection final : public Bxdf {
 public:
  SpecularReflection(const Spectrum& reflectance, const Fresnel& fresnel)
      : Bxdf(LobeSet::SpecularReflection), reflectance_(reflectance), fresnel_(fresnel) {}

  Spectrum f(const Vector3&, const Vector3&) const override { return {}; }
  Real Pdf(const Vector3&, const Vector3&) const override { return 0; }
  std::optional<BxdfSample> Sample(const Vector3& wo, Point2 u) const override;
  Spectrum Rho() const override;

 private:
  Spectrum reflectance_;
  Fresnel fresnel_;
};

// Refracts into the other side; coefficient T (1 - F). Radiance changes by the square of the
// relative index, so that L / eta^2 is constant along the refracted ray (Veach 1997, section 5.2);
// the power of photons does not. Equal indices: straight through.
class SpecularTransmission final : public Bxdf {
 public:
  SpecularTransmission(const Spectrum& transmittance, Real etaOutside, Real etaInside,
                       TransportMode mode)
      : Bxdf(LobeSet::SpecularTransmission),
        transmittance_(transmittance),
        etaOutside_(etaOutside),
        etaInside_(etaInside),
        mode_(mode) {}

  Spectrum f(const Vector3&, const Vector3&) const override { return {}; }
  Real Pdf(const Vector3&, const Vector3&) const override { return 0; }
  std::optional<BxdfSample> Sample(const Vector3& wo, Point2 u) const override;
  Spectrum Rho() const override;

 private:
  Spectrum transmittance_;
  Real etaOutside_, etaInside_;
  TransportMode mode_;
};

}  // namespace exphoton
