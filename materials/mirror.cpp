// SPDX-License-Identifier: BSD-2-Clause
// The material "mirror" is an ideal specular reflector with the same reflectance at every angle.
#include "core/scattering/lobes/specular.h"
#include "materials/common/surface_material.h"

namespace exphoton {
namespace {

struct Settings : SurfaceSettings {
  TexturePtr<Spectrum> kr = Uniform(Spectrum(1));
};

const ParamTable<Settings>& Parameters() {
  static const ParamTable<Settings> table{
      SurfaceParameters(),
      Param("Kr", &Settings::kr, "reflectance").InVersion2({.9, .9, .9}).AtLeast(0)};
  return table;
}

class Mirror final : public SurfaceMaterial {
 public:
  Mirror(const Settings& s, const MaterialContext& context) : SurfaceMaterial(s), kr_(s.kr) {
    ReadsColor("Kr", kr_, context);
    if (!kr_->IsProvablyZero()) MayHave(LobeSet::SpecularReflection);
  }

  Bsdf Evaluate(SurfaceInteraction* si, TransportMode, Arena* arena) const override {
    Bsdf bsdf = MakeBsdf(si);
    const Spectrum kr = ReadNonNegative(kr_, *si);
    if (!kr.IsBlack()) bsdf.Add(arena->Make<SpecularReflection>(kr, Fresnel::None()));
    return bsdf;
  }

 private:
  TexturePtr<Spectrum> kr_;
};

std::unique_ptr<Material> Create(const Settings& settings, const MaterialContext& context) {
  return std::make_unique<Mirror>(settings, context);
}

}  // namespace
}  // namespace exphoton

EXPHOTON_MATERIAL("mirror", "ideal mirror")
