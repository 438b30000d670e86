// SPDX-License-Identifier: BSD-2-Clause
// Surfaces, lobes and integrals for tests of scattering are defined here.
#include "tests/support/scattering.h"

#include "core/math/sampling/sampling.h"
#include "core/scattering/lobes/fresnel_blend.h"
#include "core/scattering/lobes/lafortune.h"
#include "core/scattering/lobes/lambert.h"
#include "core/scattering/lobes/microfacet.h"
#include "core/scattering/lobes/oren_nayar.h"
#include "core/scattering/lobes/transmitted.h"

namespace exphoton {

SurfaceInteraction TiltedSurface(Real angle) {
  SurfaceInteraction si = FlatSurface();
  si.shading.n = {std::sin(angle), 0, std::cos(angle)};
  si.shading.dpdu = {std::cos(angle), 0, -std::sin(angle)};
  return si;
}

std::vector<NamedLobe> SmoothLobes() {
  const Spectrum color(Real(.9), Real(.5), Real(.1));
  const Fresnel inverted = Fresnel::Dielectric(Real(1.5), 1);
  const Fresnel physical = Fresnel::Dielectric(1, Real(1.5));
  const Fresnel copper =
      Fresnel::Conductor({Real(.2), Real(.92), Real(1.1)}, {Real(3.9), Real(2.45), Real(2.14)});
  std::vector<NamedLobe> lobes;
  const auto add = [&](const std::string& name, auto lobe) {
    lobes.push_back({name, std::make_shared<const decltype(lobe)>(lobe)});
  };
  add("Lambert", Lambert(color));
  add("OrenNayar20", OrenNayar(color, Radians(20)));
  add("OrenNayar90", OrenNayar(Spectrum(1), Radians(90)));
  add("GlossBroad", Microfacet(color, Fresnel::None(), Real(.1)));
  add("Gloss10", Microfacet(Spectrum(1), Fresnel::None(), 10));
  add("Gloss1000", Microfacet(color, Fresnel::None(), 1000));
  add("GlossInverted", Microfacet(color, inverted, 20));
  add("GlossPhysical", Microfacet(color, physical, 200));
  add("GlossCopper", Microfacet(Spectrum(1), copper, 100));
  add("BlendedDiffuse", BlendedDiffuse(color, Spectrum(Real(.3))));
  add("BlendedGloss10", BlendedGloss(Spectrum(Real(.3)), 10, 10));
  add("BlendedAnisotropic", BlendedGloss(Spectrum(Real(.05)), 5, 300));
  add("BlendedSharp", BlendedGloss(Spectrum(1), 1000, 1000));
  static const LafortuneFit forward{{Spectrum(-1), Spectrum(1), {12, 30, 200}}};
  static const LafortuneFit grazing{{Spectrum(Real(-.9)), Spectrum(Real(-1.2)), {3, 5, 7}},
                                    {Spectrum(1), Spectrum(Real(-.2)), Spectrum(90)},
                                    {Spectrum(Real(-.5)), Spectrum(Real(.6)), {2, 3, 4}}};
  add("LafortuneForward", Lafortune(forward));
  add("LafortuneGrazing", Lafortune(grazing));
  add("TransmittedLambert", Transmitted<Lambert>(Lambert(color)));
  add("TransmittedGloss", Transmitted<Microfacet>(Microfacet(color, physical, 40)));
  add("TransmittedBlend", Transmitted<BlendedGloss>(BlendedGloss(Spectrum(Real(.3)), 10, 100)));
  return lobes;
}

Spectrum Albedo(const Bxdf& lobe, const Vector3& wo, int side) {
  Spectrum sum;
  for (int j = 0; j < side; ++j) {
    for (int i = 0; i < side; ++i) {
      const Point2 u((Real(i) + Real(.5)) / Real(side), (Real(j) + Real(.5)) / Real(side));
      if (const auto sample = lobe.Sample(wo, u)) sum += sample->throughput;
    }
  }
  return sum / Real(side * side);
}

Spectrum HemisphericalAlbedo(const Bxdf& lobe, int side) {
  Spectrum sum;
  for (int j = 0; j < side; ++j) {
    for (int i = 0; i < side; ++i) {
      const Point2 u((Real(i) + Real(.5)) / Real(side), (Real(j) + Real(.5)) / Real(side));
      sum += Albedo(lobe, SampleCosineHemisphere(u), side);
    }
  }
  return sum / Real(side * side);
}

}  // namespace exphoton
