// SPDX-License-Identifier: BSD-2-Clause
// The material "glass" is a smooth dielectric boundary that reflects and refracts by Fresnel's
// equations. The index of refraction is 1 outside (on the normal's side) and `index` inside.
#include "core/scattering/lobes/specular.h"
#include "materials/common/surface_material.h"

namespace exphoton {
namespace {

struct Settings : SurfaceSettings {
  TexturePtr<Spectrum> kr = Uniform(Spectrum(1));
  TexturePtr<Spectrum> kt = Uniform(Spectrum(1));
  TexturePtr<Real> index = Uniform(Real(1.5));
};

const ParamTable<Settings>& Parameters() {
  static const ParamTable<Settings> table{
      SurfaceParameters(), Param("Kr", &Settings::kr, "scales the reflection").AtLeast(0),
      Param("Kt", &Settings::kt, "scales the refraction").AtLeast(0),
      Param("index", &Settings::index, "index of refraction inside; 1 is invisible")
          .Range(1e-6, 1e6)};
  return table;
}

class Glass final : public SurfaceMaterial {
 public:
  Glass(const Settings& s, const MaterialContext& context)
      : SurfaceMaterial(s), kr_(s.kr), kt_(s.kt), index_(s.index) {
    ReadsColor("Kr", kr_, context);
    ReadsColor("Kt", kt_, context);
    Reads(index_);
    if (!kr_->IsProvablyZero() && index_->ConstantValue() != Real(1))
      MayHave(LobeSet::SpecularReflection);
    if (!kt_->IsProvablyZero()) MayHave(LobeSet::SpecularTransmission);
  }

  Bsdf Evaluate(SurfaceInteraction* si, TransportMode mode, Arena* arena) const override {
    Bsdf bsdf = MakeBsdf(si);
    const Spectrum kr = ReadNonNegative(kr_, *si), kt = ReadNonNegative(kt_, *si);
    Real index = std::clamp(ReadNonNegative(index_, *si), Real(0), Real(1e6));
    if (index == 0) index = 1;  // the texture gave no valid index
    if (!kr.IsBlack() && index != 1)
      bsdf.Add(arena->Make<SpecularReflection>(kr, Fresnel::Dielectric(1, index)));
    if (!kt.IsBlack()) bsdf.Add(arena->Make<SpecularTransmission>(kt, Real(1), index, mode));
    return bsdf;
  }

 private:
  TexturePtr<Spectrum> kr_, kt_;
  TexturePtr<Real> index_;
};

std::unique_ptr<Material> Create(const Settings& settings, const MaterialContext& context) {
  return std::make_unique<Glass>(settings, context);
}

}  // namespace
}  // namespace exphoton

EXPHOTON_MATERIAL("glass", "smooth dielectric that reflects and refracts")
