// SPDX-License-Identifier: BSD-2-Clause
// The material "uber" has diffuse, glossy and mirror reflection, and an opacity. The rest of the
// light passes straight through.
#include "core/scattering/lobes/lambert.h"
#include "core/scattering/lobes/specular.h"
#include "materials/common/gloss.h"

namespace exphoton {
namespace {

struct Settings : GlossSettings {
  TexturePtr<Spectrum> kd = Uniform(Spectrum(1));
  TexturePtr<Spectrum> ks = Uniform(Spectrum(1));
  TexturePtr<Spectrum> kr = Uniform(Spectrum(0));
  TexturePtr<Spectrum> opacity = Uniform(Spectrum(1));
};

const ParamTable<Settings>& Parameters() {
  static const ParamTable<Settings> table{
      GlossParameters(), Param("Kd", &Settings::kd, "diffuse reflectance").AtLeast(0),
      Param("Ks", &Settings::ks, "scales the gloss").AtLeast(0),
      Param("Kr", &Settings::kr, "scales the mirror reflection").AtLeast(0),
      Param("opacity", &Settings::opacity, "share that the surface stops; the rest goes through")
          .Range(0, 1)};
  return table;
}

class Uber final : public SurfaceMaterial {
 public:
  Uber(const Settings& s, const MaterialContext& context)
      : SurfaceMaterial(s),
        kd_(s.kd),
        ks_(s.ks),
        kr_(s.kr),
        opacity_(s.opacity),
        roughness_(s.roughness),
        fresnel_(FresnelOf(s.fresnel)) {
    ReadsColor("Kd", kd_, context);
    ReadsColor("Ks", ks_, context);
    ReadsColor("Kr", kr_, context);
    Reads(opacity_);
    Reads(roughness_);
    const auto opacity = opacity_->ConstantValue();
    if (!opacity || opacity->MinComponent() < 1) MayHave(LobeSet::SpecularTransmission);
    if (opacity_->IsProvablyZero()) return;
    if (!kd_->IsProvablyZero()) MayHave(LobeSet::DiffuseReflection);
    if (!ks_->IsProvablyZero()) MayHave(LobeSet::GlossyReflection);
    if (!kr_->IsProvablyZero()) MayHave(LobeSet::SpecularReflection);
  }

  Bsdf Evaluate(SurfaceInteraction* si, TransportMode mode, Arena* arena) const override {
    Bsdf bsdf = MakeBsdf(si);
    const Spectrum opacity = ReadNonNegative(opacity_, *si);
    const Spectrum through = NonNegative(Spectrum(1) - opacity);
    if (!through.IsBlack())
      bsdf.Add(arena->Make<SpecularTransmission>(through, Real(1), Real(1), mode));
    const Spectrum kd = opacity * ReadNonNegative(kd_, *si);
    if (!kd.IsBlack()) bsdf.Add(arena->Make<Lambert>(kd));
    const Spectrum ks = opacity * ReadNonNegative(ks_, *si);
    if (!ks.IsBlack()) {
      const Real exponent = BlinnExponent(roughness_->Evaluate(*si));
      bsdf.Add(arena->Make<Microfacet>(ks, fresnel_, exponent));
    }
    const Spectrum kr = opacity * ReadNonNegative(kr_, *si);
    if (!kr.IsBlack()) bsdf.Add(arena->Make<SpecularReflection>(kr, fresnel_));
    return bsdf;
  }

 private:
  TexturePtr<Spectrum> kd_, ks_, kr_, opacity_;
  TexturePtr<Real> roughness_;
  Fresnel fresnel_;
};

std::unique_ptr<Material> Create(const Settings& settings, const MaterialContext& context) {
  return std::make_unique<Uber>(settings, context);
}

}  // namespace
}  // namespace exphoton

EXPHOTON_MATERIAL("uber", "diffuse, glossy and mirror reflection with opacity")
