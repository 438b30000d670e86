// SPDX-License-Identifier: BSD-2-Clause
// The material "matte" is diffuse: Lambertian, or after Oren and Nayar (1994) if sigma > 0.
#include "core/scattering/lobes/lambert.h"
#include "core/scattering/lobes/oren_nayar.h"
#include "materials/common/surface_material.h"

namespace exphoton {
namespace {

struct Settings : SurfaceSettings {
  TexturePtr<Spectrum> kd = Uniform(Spectrum(1));
  TexturePtr<Real> sigma = Uniform(Real(0));
};

const ParamTable<Settings>& Parameters() {
  static const ParamTable<Settings> table{
      SurfaceParameters(),
      Param("Kd", &Settings::kd, "diffuse reflectance").InVersion2({.5, .5, .5}).AtLeast(0),
      Param("sigma", &Settings::sigma, "deviation of the slope of the facets; 0 is Lambert's law")
          .Range(0, 90)
          .Unit("degrees")};
  return table;
}

class Matte final : public SurfaceMaterial {
 public:
  Matte(const Settings& s, const MaterialContext& context)
      : SurfaceMaterial(s), kd_(s.kd), sigma_(s.sigma) {
    ReadsColor("Kd", kd_, context);
    Reads(sigma_);
    if (!kd_->IsProvablyZero()) MayHave(LobeSet::DiffuseReflection);
  }

  Bsdf Evaluate(SurfaceInteraction* si, TransportMode, Arena* arena) const override {
    Bsdf bsdf = MakeBsdf(si);
    const Spectrum kd = ReadNonNegative(kd_, *si);
    if (kd.IsBlack()) return bsdf;
    const Real sigma = std::min(ReadNonNegative(sigma_, *si), Real(90));
    if (sigma > 0) {
      bsdf.Add(arena->Make<OrenNayar>(kd, Radians(sigma)));
    } else {
      bsdf.Add(arena->Make<Lambert>(kd));
    }
    return bsdf;
  }

 private:
  TexturePtr<Spectrum> kd_;
  TexturePtr<Real> sigma_;
};

std::unique_ptr<Material> Create(const Settings& settings, const MaterialContext& context) {
  return std::make_unique<Matte>(settings, context);
}

}  // namespace
}  // namespace exphoton

EXPHOTON_MATERIAL("matte", "diffuse reflection, smooth or rough")
