// SPDX-License-Identifier: BSD-2-Clause
// Transmitted is diffuse or glossy transmission through a thin sheet: a reflection lobe mirrored to
// the other side. f, Pdf and Sample all mirror wi, and only its z.
#pragma once

#include "core/scattering/bxdf.h"
#include "core/scattering/lobes/local_frame.h"

namespace exphoton {

// Reflection is a concrete reflection lobe, held by value.
template <class Reflection>
class Transmitted final : public Bxdf {
 public:
  explicit Transmitted(const Reflection& reflection)
      : Bxdf(LobeSet(unsigned(reflection.Lobe()) << 3)), reflection_(reflection) {}

  Spectrum f(const Vector3& wo, const Vector3& wi) const override {
    return reflection_.f(wo, MirrorZ(wi));
  }
  Real Pdf(const Vector3& wo, const Vector3& wi) const override {
    return reflection_.Pdf(wo, MirrorZ(wi));
  }
  std::optional<BxdfSample> Sample(const Vector3& wo, Point2 u) const override {
    auto sample = reflection_.Sample(wo, u);
    if (sample) sample->wi = MirrorZ(sample->wi);
    return sample;
  }
  std::optional<Spectrum> ThroughputBound(const Vector3& wo) const override {
    return reflection_.ThroughputBound(wo);
  }
  Spectrum Rho() const override { return reflection_.Rho(); }
  bool IsLambertian() const override { return reflection_.IsLambertian(); }

 private:
  Reflection reflection_;
};

}  // namespace exphoton
