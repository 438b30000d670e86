// SPDX-License-Identifier: BSD-2-Clause
// The material "shinymetal" has mirror reflection and glossy reflection. Each has the Fresnel term
// of a conductor whose reflectance at normal incidence is the given colour.
#include "core/scattering/lobes/microfacet.h"
#include "core/scattering/lobes/specular.h"
#include "materials/common/surface_material.h"

namespace exphoton {
namespace {

struct Settings : SurfaceSettings {
  TexturePtr<Spectrum> kr = Uniform(Spectrum(1));
  TexturePtr<Spectrum> ks = Uniform(Spectrum(1));
  TexturePtr<Real> roughness = Uniform(Real(.1));
};

const ParamTable<Settings>& Parameters() {
  static const ParamTable<Settings> table{
      SurfaceParameters(),
      Param("Kr", &Settings::kr,
            "mirror reflectance at normal incidence; above .999 counts as .999")
          .AtLeast(0),
      Param("Ks", &Settings::ks,
            "glossy reflectance at normal incidence; above .999 counts as .999")
          .AtLeast(0),
      Param("roughness", &Settings::roughness,
            "inverse of the gloss exponent; below .001 counts as .001")
          .AtLeast(0)};
  return table;
}

Fresnel MetalFresnel(const Spectrum& reflectance) {
  return Fresnel::Conductor({EtaFromReflectance(reflectance.r), EtaFromReflectance(reflectance.g),
                             EtaFromReflectance(reflectance.b)},
                            Spectrum());
}

class ShinyMetal final : public SurfaceMaterial {
 public:
  ShinyMetal(const Settings& s, const MaterialContext& context)
      : SurfaceMaterial(s), kr_(s.kr), ks_(s.ks), roughness_(s.roughness) {
    ReadsColor("Kr", kr_, context);
    ReadsColor("Ks", ks_, context);
    Reads(roughness_);
    if (!ks_->IsProvablyZero()) MayHave(LobeSet::GlossyReflection);
    if (!kr_->IsProvablyZero()) MayHave(LobeSet::SpecularReflection);
  }

  Bsdf Evaluate(SurfaceInteraction* si, TransportMode, Arena* arena) const override {
    Bsdf bsdf = MakeBsdf(si);
    const Spectrum ks = ReadNonNegative(ks_, *si), kr = ReadNonNegative(kr_, *si);
    if (!ks.IsBlack()) {
      const Real exponent = BlinnExponent(roughness_->Evaluate(*si));
      bsdf.Add(arena->Make<Microfacet>(Spectrum(1), MetalFresnel(ks), exponent));
    }
    if (!kr.IsBlack()) bsdf.Add(arena->Make<SpecularReflection>(Spectrum(1), MetalFresnel(kr)));
    return bsdf;
  }

 private:
  TexturePtr<Spectrum> kr_, ks_;
  TexturePtr<Real> roughness_;
};

std::unique_ptr<Material> Create(const Settings& settings, const MaterialContext& context) {
  return std::make_unique<ShinyMetal>(settings, context);
}

}  // namespace
}  // namespace exphoton

EXPHOTON_MATERIAL("shinymetal", "mirror reflection and gloss with metallic Fresnel terms")
