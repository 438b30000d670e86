// SPDX-License-Identifier: BSD-2-Clause
// WrongMaterial is a material of one lobe, for plugins that `exphoton check-plugin` must refuse.
#pragma once

#include "core/math/sampling/sampling.h"
#include "core/plugin.h"
#include "core/scattering/lobes/local_frame.h"

namespace exphoton {

template <class Lobe>
class WrongMaterial final : public Material {
 public:
  Bsdf Evaluate(SurfaceInteraction* si, TransportMode, Arena* arena) const override {
    Bsdf bsdf(*si);
    bsdf.Add(arena->Make<Lobe>());
    return bsdf;
  }
  LobeSet PossibleLobes() const override { return LobeSet::DiffuseReflection; }
  bool NeedsDifferentials() const override { return false; }
};

// A diffuse lobe that is right except for what a derived class changes.
class RightLobe : public Bxdf {
 public:
  RightLobe() : Bxdf(LobeSet::DiffuseReflection) {}
  Spectrum f(const Vector3& wo, const Vector3& wi) const override {
    return Spectrum(SameHemisphere(wo, wi) ? kInvPi / 2 : 0);
  }
  Real Pdf(const Vector3& wo, const Vector3& wi) const override {
    return SameHemisphere(wo, wi) ? std::abs(wi.z) * kInvPi : 0;
  }
  std::optional<BxdfSample> Sample(const Vector3& wo, Point2 u) const override {
    const Vector3 wi = OnSideOf(SampleCosineHemisphere(u), wo);
    const Real pdf = Pdf(wo, wi);
    if (!(pdf > 0)) return std::nullopt;
    return BxdfSample{wi, f(wo, wi) * (std::abs(wi.z) / pdf), pdf};
  }
  Spectrum Rho() const override { return Spectrum(Real(.5)); }
};

struct NoSettings {};

}  // namespace exphoton
