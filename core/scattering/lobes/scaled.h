// SPDX-License-Identifier: BSD-2-Clause
// ScaledLobe is another lobe times a colour, for materials that mix others.
#pragma once

#include "core/scattering/bxdf.h"

namespace exphoton {

class ScaledLobe final : public Bxdf {
 public:
  // `lobe` must outlive this one. If keepsCoat is false, a coat of the lobe is not announced.
  ScaledLobe(const Bxdf& lobe, const Spectrum& scale, bool keepsCoat)
      : Bxdf(lobe.Lobe()), lobe_(lobe), scale_(scale), keepsCoat_(keepsCoat) {}

  Spectrum f(const Vector3& wo, const Vector3& wi) const override {
    return scale_ * lobe_.f(wo, wi);
  }
  Real Pdf(const Vector3& wo, const Vector3& wi) const override { return lobe_.Pdf(wo, wi); }
  std::optional<BxdfSample> Sample(const Vector3& wo, Point2 u) const override {
    auto sample = lobe_.Sample(wo, u);
    if (sample) sample->throughput *= scale_;
    return sample;
  }
  std::optional<Spectrum> ThroughputBound(const Vector3& wo) const override {
    auto bound = lobe_.ThroughputBound(wo);
    if (bound) *bound *= scale_;
    return bound;
  }
  Spectrum Rho() const override { return scale_ * lobe_.Rho(); }
  bool IsLambertian() const override { return lobe_.IsLambertian(); }
  bool IsCoated() const override { return keepsCoat_ && lobe_.IsCoated(); }

 private:
  const Bxdf& lobe_;
  Spectrum scale_;
  bool keepsCoat_;
};

}  // namespace exphoton
