// SPDX-License-Identifier: BSD-2-Clause
// These tests compare the BSDF of every material with its lobes, built directly from distinct
// values of all parameters. They also check what each texture parameter reports: possible lobes,
// warnings and the need for ray differentials.
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "core/base/arena.h"
#include "core/math/sampling/random.h"
#include "core/math/sampling/sampling.h"
#include "core/scattering/lobes/fresnel_blend.h"
#include "core/scattering/lobes/lambert.h"
#include "core/scattering/lobes/microfacet.h"
#include "core/scattering/lobes/oren_nayar.h"
#include "core/scattering/lobes/specular.h"
#include "core/scattering/lobes/transmitted.h"
#include "tests/support/scattering.h"
#include "tests/support/test_plugin.h"

namespace exphoton {
namespace {

using Lobes = std::vector<std::shared_ptr<const Bxdf>>;

template <class Lobe>
std::shared_ptr<const Bxdf> Make(const Lobe& lobe) {
  return std::make_shared<const Lobe>(lobe);
}

// A surface that is neither flat to the axes nor has its tangent along one of them.
SurfaceInteraction TurnedSurface() {
  SurfaceInteraction si = FlatSurface();
  const Real c = std::cos(Radians(30)), s = std::sin(Radians(30));
  si.dpdu = si.shading.dpdu = {c, s, 0};
  si.dpdv = si.shading.dpdv = {-s, c, 0};
  return si;
}

void ExpectSameScattering(const std::string& text, const Lobes& lobes) {
  SCOPED_TRACE(text);
  TestPlugins plugins;
  Arena arena;
  const auto material = plugins.MakeMaterial(text);
  for (const TransportMode mode : {TransportMode::Radiance, TransportMode::Importance}) {
    SurfaceInteraction si = TurnedSurface();
    const Bsdf actual = material->Evaluate(&si, mode, &arena);
    Bsdf expected(TurnedSurface());
    LobeSet kinds = LobeSet::None;
    for (const auto& lobe : lobes) {
      expected.Add(lobe.get());
      kinds = kinds | lobe->Lobe();
    }
    EXPECT_EQ(material->PossibleLobes(), kinds);
    EXPECT_EQ(actual.Count(), expected.Count());
    RandomStream random(3);
    for (int i = 0; i < 100; ++i) {
      const Vector3 wo = SampleUniformSphere({random.Uniform(), random.Uniform()});
      const Vector3 wi = SampleUniformSphere({random.Uniform(), random.Uniform()});
      for (unsigned bit = 1; bit <= unsigned(LobeSet::All); bit *= 2) {
        const auto kind = LobeSet(bit);
        EXPECT_EQ(actual.Count(kind), expected.Count(kind)) << bit;
        EXPECT_EQ(actual.f(wo, wi, kind), expected.f(wo, wi, kind)) << bit;
        EXPECT_EQ(actual.Pdf(wo, wi, kind), expected.Pdf(wo, wi, kind)) << bit;
        EXPECT_EQ(actual.Rho(kind), expected.Rho(kind)) << bit;
        if (!Intersects(kind, LobeSet::Specular)) continue;
        const auto a = actual.Sample(wo, {}, 0, kind, mode);
        const auto b = expected.Sample(wo, {}, 0, kind, mode);
        ASSERT_EQ(a.has_value(), b.has_value());
        if (!a) continue;
        EXPECT_EQ(a->wi, b->wi);
        // A refraction of the other mode has another factor; expected lobes are of Importance.
        if (mode == TransportMode::Importance || !a->IsTransmission() || a->eta == 1) {
          EXPECT_EQ(a->throughput, b->throughput);
        }
      }
    }
  }
}

const Spectrum kA(Real(.1), Real(.3), Real(.5)), kB(Real(.4), Real(.2), Real(.6));
const Spectrum kC(Real(.7), Real(.15), Real(.25)), kD(Real(.35), Real(.45), Real(.05));
const Fresnel kInverted = Fresnel::Dielectric(Real(1.5), 1);
const Fresnel kPhysical = Fresnel::Dielectric(1, Real(1.5));

Fresnel Metal(const Spectrum& r) {
  return Fresnel::Conductor(
      {EtaFromReflectance(r.r), EtaFromReflectance(r.g), EtaFromReflectance(r.b)}, Spectrum());
}

TEST(MaterialParameters, OfMatte) {
  ExpectSameScattering(R"("matte" "color Kd" [.1 .3 .5])", {Make(Lambert(kA))});
  ExpectSameScattering(R"("matte")", {Make(Lambert(Spectrum(1)))});
  ExpectSameScattering(R"("matte" "color Kd" [.1 .3 .5] "float sigma" 25)",
                       {Make(OrenNayar(kA, Radians(25)))});
  ExpectSameScattering(R"("matte" "float sigma" 90)", {Make(OrenNayar(Spectrum(1), Radians(90)))});
}

TEST(MaterialParameters, OfPlastic) {
  const std::string colors = R"("plastic" "color Kd" [.1 .3 .5] "color Ks" [.4 .2 .6])";
  ExpectSameScattering(colors, {Make(Lambert(kA)), Make(Microfacet(kB, kInverted, 10))});
  ExpectSameScattering(colors + R"( "float roughness" .25)",
                       {Make(Lambert(kA)), Make(Microfacet(kB, kInverted, 4))});
  ExpectSameScattering(colors + R"( "string fresnel" "physical")",
                       {Make(Lambert(kA)), Make(Microfacet(kB, kPhysical, 10))});
  ExpectSameScattering(R"("plastic")",
                       {Make(Lambert(Spectrum(1))), Make(Microfacet(Spectrum(1), kInverted, 10))});
  ExpectSameScattering(R"("plastic" "color Ks" [0 0 0])", {Make(Lambert(Spectrum(1)))});
  ExpectSameScattering(R"("plastic" "color Kd" [0 0 0])",
                       {Make(Microfacet(Spectrum(1), kInverted, 10))});
}

TEST(MaterialParameters, OfTranslucent) {
  const std::string colors =
      R"("translucent" "color Kd" [.1 .3 .5] "color Ks" [.4 .2 .6] "color reflect" [.7 .15 .25]
         "color transmit" [.35 .45 .05])";
  const auto lobes = [](const Fresnel& fresnel, Real exponent) {
    return Lobes{Make(Lambert(kA * kC)), Make(Transmitted<Lambert>(Lambert(kA * kD))),
                 Make(Microfacet(kB * kC, fresnel, exponent)),
                 Make(Transmitted<Microfacet>(Microfacet(kB * kD, fresnel, exponent)))};
  };
  ExpectSameScattering(colors, lobes(kInverted, 10));
  ExpectSameScattering(colors + R"( "float roughness" .25 "string fresnel" "physical")",
                       lobes(kPhysical, 4));
  const Spectrum half(Real(.5));
  ExpectSameScattering(R"("translucent" "color Ks" [0 0 0])",
                       {Make(Lambert(half)), Make(Transmitted<Lambert>(Lambert(half)))});
  ExpectSameScattering(R"("translucent" "color Kd" [0 0 0] "color reflect" [0 0 0])",
                       {Make(Transmitted<Microfacet>(Microfacet(half, kInverted, 10)))});
}

TEST(MaterialParameters, OfUber) {
  const std::string colors =
      R"("uber" "color Kd" [.1 .3 .5] "color Ks" [.4 .2 .6] "color Kr" [.7 .15 .25]
         "color opacity" [.35 .45 .05])";
  const auto lobes = [](const Fresnel& fresnel, Real exponent) {
    return Lobes{Make(SpecularTransmission(Spectrum(1) - kD, 1, 1, TransportMode::Importance)),
                 Make(Lambert(kD * kA)), Make(Microfacet(kD * kB, fresnel, exponent)),
                 Make(SpecularReflection(kD * kC, fresnel))};
  };
  ExpectSameScattering(colors, lobes(kInverted, 10));
  ExpectSameScattering(colors + R"( "float roughness" .25 "string fresnel" "physical")",
                       lobes(kPhysical, 4));
  ExpectSameScattering(R"("uber")",
                       {Make(Lambert(Spectrum(1))), Make(Microfacet(Spectrum(1), kInverted, 10))});
  ExpectSameScattering(R"("uber" "color opacity" [0 0 0])",
                       {Make(SpecularTransmission(Spectrum(1), 1, 1, TransportMode::Importance))});
  // One transparent channel is enough to let light through.
  ExpectSameScattering(
      R"("uber" "color Kd" [0 0 0] "color Ks" [0 0 0] "color opacity" [1 1 .5])",
      {Make(SpecularTransmission({0, 0, Real(.5)}, 1, 1, TransportMode::Importance))});
}

TEST(MaterialParameters, OfGlass) {
  const auto lobes = [](const Spectrum& kr, const Spectrum& kt, Real index) {
    return Lobes{Make(SpecularReflection(kr, Fresnel::Dielectric(1, index))),
                 Make(SpecularTransmission(kt, 1, index, TransportMode::Importance))};
  };
  ExpectSameScattering(R"("glass" "color Kr" [.1 .3 .5] "color Kt" [.4 .2 .6] "float index" 1.7)",
                       lobes(kA, kB, Real(1.7)));
  ExpectSameScattering(R"("glass")", lobes(Spectrum(1), Spectrum(1), Real(1.5)));
  ExpectSameScattering(R"("glass" "color Kt" [0 0 0])",
                       {Make(SpecularReflection(Spectrum(1), kPhysical))});
}

TEST(MaterialParameters, OfMirrorAndMetals) {
  ExpectSameScattering(R"("mirror" "color Kr" [.1 .3 .5])",
                       {Make(SpecularReflection(kA, Fresnel::None()))});
  ExpectSameScattering(R"("mirror")", {Make(SpecularReflection(Spectrum(1), Fresnel::None()))});
  ExpectSameScattering(
      R"("metal" "color eta" [.1 .3 .5] "color k" [1.4 2.2 3.6] "float roughness" .04)",
      {Make(
          Microfacet(Spectrum(1), Fresnel::Conductor(kA, {Real(1.4), Real(2.2), Real(3.6)}), 25))});
  ExpectSameScattering(
      R"("metal")",
      {Make(Microfacet(Spectrum(1),
                       Fresnel::Conductor({Real(.200438), Real(.924033), Real(1.102212)},
                                          {Real(3.912949), Real(2.452848), Real(2.142188)}),
                       100))});
  ExpectSameScattering(
      R"("shinymetal" "color Kr" [.1 .3 .5] "color Ks" [.4 .2 .6] "float roughness" .04)",
      {Make(Microfacet(Spectrum(1), Metal(kB), 25)),
       Make(SpecularReflection(Spectrum(1), Metal(kA)))});
  ExpectSameScattering(R"("shinymetal" "color Kr" [0 0 0] "color Ks" [.4 .2 .6])",
                       {Make(Microfacet(Spectrum(1), Metal(kB), 10))});
  ExpectSameScattering(R"("shinymetal" "color Ks" [0 0 0] "color Kr" [.4 .2 .6])",
                       {Make(SpecularReflection(Spectrum(1), Metal(kB)))});
}

TEST(MaterialParameters, OfSubstrate) {
  ExpectSameScattering(
      R"("substrate" "color Kd" [.1 .3 .5] "color Ks" [.4 .2 .6] "float uroughness" .04
         "float vroughness" .2)",
      {Make(BlendedDiffuse(kA, kB)), Make(BlendedGloss(kB, 25, 5))});
  const Spectrum half(Real(.5));
  ExpectSameScattering(R"("substrate")",
                       {Make(BlendedDiffuse(half, half)), Make(BlendedGloss(half, 10, 10))});
  ExpectSameScattering(
      R"("substrate" "color Ks" [0 0 0])",
      {Make(BlendedDiffuse(half, Spectrum())), Make(BlendedGloss(Spectrum(), 10, 10))});
  ExpectSameScattering(R"("substrate" "color Ks" [0 0 0] "color Kd" [0 0 0])", {});
}

struct Texturable {
  const char* material;
  std::vector<const char*> colors, floats;  // colors: reflectances
  std::vector<const char*> others{};        // colour textures that are no reflectances
};

const std::vector<Texturable>& AllTexturable() {
  static const std::vector<Texturable> all{
      {"matte", {"Kd"}, {"sigma"}},
      {"plastic", {"Kd", "Ks"}, {"roughness"}},
      {"translucent", {"Kd", "Ks", "reflect", "transmit"}, {"roughness"}},
      {"uber", {"Kd", "Ks", "Kr"}, {"roughness"}, {"opacity"}},
      {"glass", {"Kr", "Kt"}, {"index"}},
      {"mirror", {"Kr"}, {}},
      {"metal", {}, {"roughness"}, {"eta", "k"}},
      {"shinymetal", {"Kr", "Ks"}, {"roughness"}},
      {"substrate", {"Kd", "Ks"}, {"uroughness", "vroughness"}},
  };
  return all;
}

template <class T>
class Filtered final : public Texture<T> {
 public:
  T Evaluate(const SurfaceInteraction&) const override { return T(Real(.5)); }
  bool IsFiltered() const override { return true; }
};

TEST(MaterialParameters, ThatAreFilteredTexturesNeedDifferentials) {
  TestPlugins plugins;
  plugins.Define("c", std::make_shared<const Filtered<Spectrum>>());
  plugins.Define("f", std::make_shared<const Filtered<Real>>());
  const auto needs = [&](const std::string& material, const std::string& parameter) {
    return plugins.MakeMaterial("\"" + material + "\" " + parameter)->NeedsDifferentials();
  };
  for (const Texturable& m : AllTexturable()) {
    EXPECT_FALSE(needs(m.material, "")) << m.material;
    for (const auto* names : {&m.colors, &m.others})
      for (const char* name : *names)
        EXPECT_TRUE(needs(m.material, std::string("\"texture ") + name + "\" \"c\""))
            << m.material << ' ' << name;
    for (const char* name : m.floats)
      EXPECT_TRUE(needs(m.material, std::string("\"texture ") + name + "\" \"f\""))
          << m.material << ' ' << name;
  }
}

// A warning names the parameter, and a reflectance of exactly 1 gives none.
TEST(MaterialParameters, ThatReflectMoreThanAllAreNamed) {
  for (const Texturable& m : AllTexturable()) {
    for (const char* name : m.colors) {
      TestPlugins plugins;
      const std::string before = std::string("\"") + m.material + "\" \"color " + name + "\" ";
      plugins.MakeMaterial(before + "[1 1 1]");
      EXPECT_EQ(plugins.GetLog().WarningCount(), 0) << before;
      plugins.MakeMaterial(before + "[.5 .5 1.25]");
      EXPECT_EQ(plugins.GetLog().WarningCount(), 1) << before;
      const auto messages = plugins.GetLog().Messages();
      ASSERT_FALSE(messages.empty());
      EXPECT_NE(messages.back().find(std::string("'") + name + "' is above 1"), std::string::npos)
          << messages.back();
    }
  }
}

}  // namespace
}  // namespace exphoton
