// SPDX-License-Identifier: BSD-2-Clause
// The material "translucent" has diffuse and glossy reflection, and transmission by the same lobes
// mirrored to the other side. It suits leaves, lamp shades and paper.
#include "core/scattering/lobes/lambert.h"
#include "core/scattering/lobes/transmitted.h"
#include "materials/common/gloss.h"

namespace exphoton {
namespace {

struct Settings : GlossSettings {
  TexturePtr<Spectrum> kd = Uniform(Spectrum(1));
  TexturePtr<Spectrum> ks = Uniform(Spectrum(1));
  TexturePtr<Spectrum> reflect = Uniform(Spectrum(Real(.5)));
  TexturePtr<Spectrum> transmit = Uniform(Spectrum(Real(.5)));
};

const ParamTable<Settings>& Parameters() {
  static const ParamTable<Settings> table{
      GlossParameters(),
      Param("Kd", &Settings::kd, "diffuse reflectance and transmittance")
          .InVersion2({.25, .25, .25})
          .AtLeast(0),
      Param("Ks", &Settings::ks, "scales the gloss").InVersion2({.25, .25, .25}).AtLeast(0),
      Param("reflect", &Settings::reflect, "share that is reflected").AtLeast(0),
      Param("transmit", &Settings::transmit, "share that goes through").AtLeast(0)};
  return table;
}

class Translucent final : public SurfaceMaterial {
 public:
  Translucent(const Settings& s, const MaterialContext& context)
      : SurfaceMaterial(s),
        kd_(s.kd),
        ks_(s.ks),
        reflect_(s.reflect),
        transmit_(s.transmit),
        roughness_(s.roughness),
        fresnel_(FresnelOf(s.fresnel)) {
    ReadsColor("Kd", kd_, context);
    ReadsColor("Ks", ks_, context);
    ReadsColor("reflect", reflect_, context);
    ReadsColor("transmit", transmit_, context);
    Reads(roughness_);
    const bool reflects = !reflect_->IsProvablyZero(), transmits = !transmit_->IsProvablyZero();
    const bool isDiffuse = !kd_->IsProvablyZero(), isGlossy = !ks_->IsProvablyZero();
    if (isDiffuse && reflects) MayHave(LobeSet::DiffuseReflection);
    if (isDiffuse && transmits) MayHave(LobeSet::DiffuseTransmission);
    if (isGlossy && reflects) MayHave(LobeSet::GlossyReflection);
    if (isGlossy && transmits) MayHave(LobeSet::GlossyTransmission);
  }

  Bsdf Evaluate(SurfaceInteraction* si, TransportMode, Arena* arena) const override {
    Bsdf bsdf = MakeBsdf(si);
    const Spectrum r = ReadNonNegative(reflect_, *si), t = ReadNonNegative(transmit_, *si);
    const Spectrum kd = ReadNonNegative(kd_, *si), ks = ReadNonNegative(ks_, *si);
    if (const Spectrum c = kd * r; !c.IsBlack()) bsdf.Add(arena->Make<Lambert>(c));
    if (const Spectrum c = kd * t; !c.IsBlack())
      bsdf.Add(arena->Make<Transmitted<Lambert>>(Lambert(c)));
    if (ks.IsBlack()) return bsdf;
    const Real exponent = BlinnExponent(roughness_->Evaluate(*si));
    if (const Spectrum c = ks * r; !c.IsBlack())
      bsdf.Add(arena->Make<Microfacet>(c, fresnel_, exponent));
    if (const Spectrum c = ks * t; !c.IsBlack())
      bsdf.Add(arena->Make<Transmitted<Microfacet>>(Microfacet(c, fresnel_, exponent)));
    return bsdf;
  }

 private:
  TexturePtr<Spectrum> kd_, ks_, reflect_, transmit_;
  TexturePtr<Real> roughness_;
  Fresnel fresnel_;
};

std::unique_ptr<Material> Create(const Settings& settings, const MaterialContext& context) {
  return std::make_unique<Translucent>(settings, context);
}

}  // namespace
}  // namespace exphoton

EXPHOTON_MATERIAL("translucent", "diffuse and glossy reflection and transmission")
