// SPDX-License-Identifier: BSD-2-Clause
// The material "substrate" is a diffuse base under an anisotropic glossy coat (Ashikhmin and
// Shirley 2000), for varnished wood and painted surfaces.
#include "core/scattering/lobes/blinn.h"
#include "core/scattering/lobes/fresnel_blend.h"
#include "materials/common/surface_material.h"

namespace exphoton {
namespace {

struct Settings : SurfaceSettings {
  TexturePtr<Spectrum> kd = Uniform(Spectrum(Real(.5)));
  TexturePtr<Spectrum> ks = Uniform(Spectrum(Real(.5)));
  TexturePtr<Real> uRoughness = Uniform(Real(.1));
  TexturePtr<Real> vRoughness = Uniform(Real(.1));
};

const ParamTable<Settings>& Parameters() {
  static const ParamTable<Settings> table{
      SurfaceParameters(), Param("Kd", &Settings::kd, "reflectance of the base").AtLeast(0),
      Param("Ks", &Settings::ks, "reflectance of the coat at normal incidence").AtLeast(0),
      Param("uroughness", &Settings::uRoughness,
            "inverse of the gloss exponent along u; below .001 counts as .001")
          .AtLeast(0),
      Param("vroughness", &Settings::vRoughness,
            "inverse of the gloss exponent along v; below .001 counts as .001")
          .AtLeast(0)};
  return table;
}

class Substrate final : public SurfaceMaterial {
 public:
  Substrate(const Settings& s, const MaterialContext& context)
      : SurfaceMaterial(s),
        kd_(s.kd),
        ks_(s.ks),
        uRoughness_(s.uRoughness),
        vRoughness_(s.vRoughness) {
    ReadsColor("Kd", kd_, context);
    ReadsColor("Ks", ks_, context);
    Reads(uRoughness_);
    Reads(vRoughness_);
    if (kd_->IsProvablyZero() && ks_->IsProvablyZero()) return;
    MayHave(LobeSet::GlossyReflection);
    if (!kd_->IsProvablyZero()) MayHave(LobeSet::DiffuseReflection);
  }

  Bsdf Evaluate(SurfaceInteraction* si, TransportMode, Arena* arena) const override {
    Bsdf bsdf = MakeBsdf(si);
    const Spectrum kd = ReadNonNegative(kd_, *si), ks = ReadNonNegative(ks_, *si);
    if (kd.IsBlack() && ks.IsBlack()) return bsdf;
    const bool hasBase = !kd.IsBlack() && ks.MinComponent() < 1;
    if (hasBase) bsdf.Add(arena->Make<BlendedDiffuse>(kd, ks));
    bsdf.Add(arena->Make<BlendedGloss>(ks, BlinnExponent(uRoughness_->Evaluate(*si)),
                                       BlinnExponent(vRoughness_->Evaluate(*si))));
    return bsdf;
  }

 private:
  TexturePtr<Spectrum> kd_, ks_;
  TexturePtr<Real> uRoughness_, vRoughness_;
};

std::unique_ptr<Material> Create(const Settings& settings, const MaterialContext& context) {
  return std::make_unique<Substrate>(settings, context);
}

}  // namespace
}  // namespace exphoton

EXPHOTON_MATERIAL("substrate", "diffuse base under an anisotropic glossy coat")
