// SPDX-License-Identifier: BSD-2-Clause
// The material "uber" has diffuse, glossy and mirror reflection, refraction, and an opacity that
// scales them. The rest of the light passes straight through. Kt and index are parameters of
// version 2; in version 1 there is no refraction, and the index is 1.5.
#include "core/scattering/lobes/lambert.h"
#include "core/scattering/lobes/specular.h"
#include "materials/common/gloss.h"

namespace exphoton {
namespace {

struct Settings : GlossSettings {
  TexturePtr<Spectrum> kd = Uniform(Spectrum(1));
  TexturePtr<Spectrum> ks = Uniform(Spectrum(1));
  TexturePtr<Spectrum> kr = Uniform(Spectrum(0));
  TexturePtr<Spectrum> kt = Uniform(Spectrum(0));
  TexturePtr<Spectrum> opacity = Uniform(Spectrum(1));
  TexturePtr<Real> index = Uniform(Real(1.5));
};

const ParamTable<Settings>& Parameters() {
  static const ParamTable<Settings> table{
      GlossParameters(),
      Param("Kd", &Settings::kd, "diffuse reflectance").InVersion2({.25, .25, .25}).AtLeast(0),
      Param("Ks", &Settings::ks, "scales the gloss").InVersion2({.25, .25, .25}).AtLeast(0),
      Param("Kr", &Settings::kr, "scales the mirror reflection").AtLeast(0),
      Param("Kt", &Settings::kt, "scales the refraction").AtLeast(0),
      Param("opacity", &Settings::opacity, "share that the surface stops; the rest goes through")
          .Range(0, 1),
      Param("index", &Settings::index, "index of refraction for the gloss, Kr and Kt")
          .Range(1e-6, 1e6)};
  return table;
}

class Uber final : public SurfaceMaterial {
 public:
  Uber(const Settings& s, const MaterialContext& context)
      : SurfaceMaterial(s),
        kd_(s.kd),
        ks_(s.ks),
        kr_(s.kr),
        kt_(s.kt),
        opacity_(s.opacity),
        roughness_(s.roughness),
        index_(s.index),
        fresnel_(s.fresnel) {
    ReadsColor("Kd", kd_, context);
    ReadsColor("Ks", ks_, context);
    ReadsColor("Kr", kr_, context);
    ReadsColor("Kt", kt_, context);
    Reads(opacity_);
    Reads(roughness_);
    Reads(index_);
    const auto opacity = opacity_->ConstantValue();
    if (!opacity || opacity->MinComponent() < 1) MayHave(LobeSet::SpecularTransmission);
    if (opacity_->IsProvablyZero()) return;
    if (!kd_->IsProvablyZero()) MayHave(LobeSet::DiffuseReflection);
    if (!ks_->IsProvablyZero()) MayHave(LobeSet::GlossyReflection);
    if (!kr_->IsProvablyZero()) MayHave(LobeSet::SpecularReflection);
    if (!kt_->IsProvablyZero()) MayHave(LobeSet::SpecularTransmission);
  }

  Bsdf Evaluate(SurfaceInteraction* si, TransportMode mode, Arena* arena) const override {
    Bsdf bsdf = MakeBsdf(si);
    const Spectrum opacity = ReadNonNegative(opacity_, *si);
    const Spectrum through = NonNegative(Spectrum(1) - opacity);
    if (!through.IsBlack())
      bsdf.Add(arena->Make<SpecularTransmission>(through, Real(1), Real(1), mode));
    const Spectrum kd = opacity * ReadNonNegative(kd_, *si);
    if (!kd.IsBlack()) bsdf.Add(arena->Make<Lambert>(kd));
    const Real index = Index(*si);
    const Fresnel fresnel = FresnelOf(fresnel_, index);
    const Spectrum ks = opacity * ReadNonNegative(ks_, *si);
    if (!ks.IsBlack()) {
      const Real exponent = BlinnExponent(roughness_->Evaluate(*si));
      bsdf.Add(arena->Make<Microfacet>(ks, fresnel, exponent));
    }
    const Spectrum kr = opacity * ReadNonNegative(kr_, *si);
    if (!kr.IsBlack()) bsdf.Add(arena->Make<SpecularReflection>(kr, fresnel));
    const Spectrum kt = opacity * ReadNonNegative(kt_, *si);
    if (!kt.IsBlack()) {
      // As in version 2, the inverted meaning has the denser side outside.
      const bool isInverted = fresnel_ == CoatFresnel::Inverted;
      bsdf.Add(arena->Make<SpecularTransmission>(kt, isInverted ? index : 1, isInverted ? 1 : index,
                                                 mode));
    }
    return bsdf;
  }

 private:
  // Returns 1, which is invisible, where the texture gives no valid index.
  Real Index(const SurfaceInteraction& si) const {
    const Real index = ReadNonNegative(index_, si);
    return index > 0 ? std::min(index, Real(1e6)) : 1;
  }

  TexturePtr<Spectrum> kd_, ks_, kr_, kt_, opacity_;
  TexturePtr<Real> roughness_, index_;
  CoatFresnel fresnel_;
};

std::unique_ptr<Material> Create(const Settings& settings, const MaterialContext& context) {
  return std::make_unique<Uber>(settings, context);
}

}  // namespace
}  // namespace exphoton

EXPHOTON_MATERIAL("uber", "diffuse, glossy and mirror reflection and refraction, with opacity")
