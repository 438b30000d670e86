// SPDX-License-Identifier: BSD-2-Clause
// The material "metal" has glossy reflection with the Fresnel term of a measured conductor. The
// default is copper.
#include "core/scattering/lobes/microfacet.h"
#include "materials/common/surface_material.h"

namespace exphoton {
namespace {

struct Settings : SurfaceSettings {
  // Copper: measured spectra, converted to linear RGB.
  TexturePtr<Spectrum> eta = Uniform(Spectrum(Real(.200438), Real(.924033), Real(1.102212)));
  TexturePtr<Spectrum> k = Uniform(Spectrum(Real(3.912949), Real(2.452848), Real(2.142188)));
  TexturePtr<Real> roughness = Uniform(Real(.01));
};

const ParamTable<Settings>& Parameters() {
  static const ParamTable<Settings> table{
      SurfaceParameters(), Param("eta", &Settings::eta, "index of refraction").Range(0, 1e6),
      Param("k", &Settings::k, "absorption coefficient").Range(0, 1e6),
      Param("roughness", &Settings::roughness,
            "inverse of the gloss exponent; below .001 counts as .001")
          .AtLeast(0)};
  return table;
}

class Metal final : public SurfaceMaterial {
 public:
  Metal(const Settings& s, const MaterialContext& context)
      : SurfaceMaterial(s), eta_(s.eta), k_(s.k), roughness_(s.roughness) {
    (void)context;
    Reads(eta_);
    Reads(k_);
    Reads(roughness_);
    MayHave(LobeSet::GlossyReflection);
  }

  Bsdf Evaluate(SurfaceInteraction* si, TransportMode, Arena* arena) const override {
    Bsdf bsdf = MakeBsdf(si);
    const Spectrum eta = ReadNonNegative(eta_, *si), k = ReadNonNegative(k_, *si);
    const Real exponent = BlinnExponent(roughness_->Evaluate(*si));
    bsdf.Add(arena->Make<Microfacet>(Spectrum(1), Fresnel::Conductor(eta, k), exponent));
    return bsdf;
  }

 private:
  TexturePtr<Spectrum> eta_, k_;
  TexturePtr<Real> roughness_;
};

std::unique_ptr<Material> Create(const Settings& settings, const MaterialContext& context) {
  return std::make_unique<Metal>(settings, context);
}

}  // namespace
}  // namespace exphoton

EXPHOTON_MATERIAL("metal", "glossy conductor with index and absorption")
