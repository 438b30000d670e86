// SPDX-License-Identifier: BSD-2-Clause
// The material "plastic" has diffuse reflection under a glossy coat.
#include "core/scattering/lobes/lambert.h"
#include "materials/common/gloss.h"

namespace exphoton {
namespace {

struct Settings : GlossSettings {
  TexturePtr<Spectrum> kd = Uniform(Spectrum(1));
  TexturePtr<Spectrum> ks = Uniform(Spectrum(1));
};

const ParamTable<Settings>& Parameters() {
  static const ParamTable<Settings> table{
      GlossParameters(),
      Param("Kd", &Settings::kd, "diffuse reflectance").InVersion2({.25, .25, .25}).AtLeast(0),
      Param("Ks", &Settings::ks, "scales the gloss").InVersion2({.25, .25, .25}).AtLeast(0)};
  return table;
}

class Plastic final : public SurfaceMaterial {
 public:
  Plastic(const Settings& s, const MaterialContext& context)
      : SurfaceMaterial(s),
        kd_(s.kd),
        ks_(s.ks),
        roughness_(s.roughness),
        fresnel_(FresnelOf(s.fresnel)) {
    ReadsColor("Kd", kd_, context);
    ReadsColor("Ks", ks_, context);
    Reads(roughness_);
    if (!kd_->IsProvablyZero()) MayHave(LobeSet::DiffuseReflection);
    if (!ks_->IsProvablyZero()) MayHave(LobeSet::GlossyReflection);
  }

  Bsdf Evaluate(SurfaceInteraction* si, TransportMode, Arena* arena) const override {
    Bsdf bsdf = MakeBsdf(si);
    const Spectrum kd = ReadNonNegative(kd_, *si), ks = ReadNonNegative(ks_, *si);
    if (!kd.IsBlack()) bsdf.Add(arena->Make<Lambert>(kd));
    if (!ks.IsBlack()) {
      const Real exponent = BlinnExponent(roughness_->Evaluate(*si));
      bsdf.Add(arena->Make<Microfacet>(ks, fresnel_, exponent));
    }
    return bsdf;
  }

 private:
  TexturePtr<Spectrum> kd_, ks_;
  TexturePtr<Real> roughness_;
  Fresnel fresnel_;
};

std::unique_ptr<Material> Create(const Settings& settings, const MaterialContext& context) {
  return std::make_unique<Plastic>(settings, context);
}

}  // namespace
}  // namespace exphoton

EXPHOTON_MATERIAL("plastic", "diffuse reflection with glossy highlights")
