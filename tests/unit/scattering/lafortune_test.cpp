// SPDX-License-Identifier: BSD-2-Clause
// These tests check the materials with published Lafortune fits: values by the formula, with
// coefficients that are stated here once more, and albedos by an independent quadrature.
// bxdf_test.cpp and bsdf_sampling_test.cpp check the lobe itself.
#include <gtest/gtest.h>

#include "core/base/arena.h"
#include "core/math/sampling/sampling.h"
#include "core/scattering/lobes/lafortune.h"
#include "tests/support/scattering.h"
#include "tests/support/test_plugin.h"

namespace exphoton {
namespace {

// One channel of a material: the diffuse reflectance, then Cxy, Cz and n of each lobe.
struct Channel {
  const char* material;
  int channel;
  double diffuse;
  double lobes[3][3];
};
const Channel kChannels[] = {
    {"bluepaint",
     0,
     .3094,
     {{.870567, .803624, 21.820103},
      {-.451218, .023123, 2.774499},
      {-1.031545, .706734, 66.89906}}},
    {"bluepaint",
     2,
     .70837,
     {{.670982, .586674, 7.472717},
      {-.477976, .227295, 3.677653},
      {-1.026588, .687715, 57.489181}}},
    {"brushedmetal",
     1,
     0,
     {{-1.11845, 1.01469, 15.6489}, {-1.06409, .662178, 88.9222}, {-1.01635, 1.00112, 184.152}}},
    {"clay",
     1,
     .260749,
     {{-1.102701, -2.714801, 11.024489},
      {-.79332, .679314, 9.055139},
      {-1.012378, .885239, 141.937171}}},
    {"felt",
     0,
     .025865,
     {{-.304075, -.065992, 3.047892},
      {-.749561, -1.167929, 6.931827},
      {1.004921, -.205529, 94.117332}}},
    {"primer",
     2,
     .133209,
     {{-1.058104, -.068002, 8.117645},
      {-1.087779, -.053605, 41.98899},
      {-.449038, .173224, 2.636161}}},
    {"primer",
     0,
     .11823,
     {{-.399286, .167504, 2.466633},
      {-1.041861, .014375, 7.993722},
      {-1.098605, -.14511, 31.899719}}},
    {"primer",
     1,
     .121218,
     {{-1.033473, .009545, 7.637253},
      {-1.100108, -.198147, 29.446268},
      {-.379883, .159127, 2.372852}}},
    {"skin",
     0,
     .428425,
     {{-1.131747, -1.209182, 6.421658},
      {-.54657, .380123, 3.685044},
      {-.998888, .857998, 64.208486}}}};

class LafortuneMaterials : public testing::Test {
 protected:
  Bsdf Evaluate(const std::string& name) {
    SurfaceInteraction si = FlatSurface();
    return plugins_.MakeMaterial("\"" + name + "\"")
        ->Evaluate(&si, TransportMode::Radiance, &arena_);
  }
  // Returns the integral of f |cos wi| over wi, by the midpoint rule.
  Spectrum AlbedoAt(const Bsdf& bsdf, Real cosine) {
    constexpr int kSteps = 300;
    const Vector3 wo(std::sqrt(1 - cosine * cosine), 0, cosine);
    double sum[3] = {};
    for (int i = 0; i < kSteps * kSteps; ++i) {
      const Real z = (Real(i % kSteps) + Real(.5)) / kSteps;
      const Real phi = kPi * (Real(i / kSteps) + Real(.5)) / kSteps;
      const Spectrum f = bsdf.f(wo, SphericalDirection(std::sqrt(1 - z * z), z, phi));
      for (int c = 0; c < 3; ++c) sum[c] += double(f[c] * z);
    }
    const double step = 2 * M_PI / (double(kSteps) * kSteps);
    return {Real(sum[0] * step), Real(sum[1] * step), Real(sum[2] * step)};
  }

  TestPlugins plugins_;
  Arena arena_;
};

TEST_F(LafortuneMaterials, HaveTheValuesOfTheFormula) {
  for (const Channel& expected : kChannels) {
    const Bsdf bsdf = Evaluate(expected.material);
    for (const double polar : {.1, .7, 1.2, 1.5}) {
      for (const double azimuth : {0., 1., 2.5, M_PI}) {
        const double a[3] = {std::sin(.9), 0, std::cos(.9)};
        const double b[3] = {std::sin(polar) * std::cos(azimuth),
                             std::sin(polar) * std::sin(azimuth), std::cos(polar)};
        double value = expected.diffuse / M_PI;
        for (const auto& lobe : expected.lobes) {
          const double base = lobe[0] * (a[0] * b[0] + a[1] * b[1]) + lobe[1] * a[2] * b[2];
          if (base > 0) value += std::pow(base, lobe[2]);
        }
        const Spectrum f =
            bsdf.f({Real(a[0]), Real(a[1]), Real(a[2])}, {Real(b[0]), Real(b[1]), Real(b[2])});
        EXPECT_NEAR(double(f[expected.channel]), value, 2e-4 * value)
            << expected.material << ' ' << polar << ' ' << azimuth;
      }
    }
  }
}

// The sums over the channels come from a midpoint quadrature in another program, to four digits.
TEST_F(LafortuneMaterials, HaveTheirHemisphericalReflectance) {
  const std::pair<const char*, Spectrum> expected[] = {
      {"bluepaint", {Real(.3333), Real(.4204), Real(.7388)}},
      {"brushedmetal", {Real(.7620), Real(.7728), Real(.8193)}},
      {"clay", {Real(.4120), Real(.2883), Real(.2998)}},
      {"felt", {Real(.0287), Real(.0287), Real(.0287)}},
      {"primer", {Real(.1883), Real(.1914), Real(.2024)}},
      {"skin", {Real(.4874), Real(.3606), Real(.3879)}}};
  for (const auto& [name, rho] : expected) {
    const Spectrum stated = Evaluate(name).Rho(LobeSet::All);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(double(stated[c]), double(rho[c]), .005) << name;
  }
}

TEST_F(LafortuneMaterials, GainNoEnergyExceptBrushedMetalAtGrazingAngles) {
  for (const Real cosine :
       {Real(1e-3), Real(.05), Real(.14), Real(.3), Real(.35), Real(.6), Real(1)}) {
    for (const char* name : {"bluepaint", "clay", "felt", "primer", "skin"})
      EXPECT_LE(AlbedoAt(Evaluate(name), cosine).MaxComponent(), Real(.78)) << name << cosine;
    const Real metal = AlbedoAt(Evaluate("brushedmetal"), cosine).MaxComponent();
    EXPECT_LE(metal, cosine > Real(.32) ? Real(1) : Real(1.61)) << cosine;
  }
  EXPECT_GT(AlbedoAt(Evaluate("brushedmetal"), Real(.14)).b, Real(1.55));
}

TEST_F(LafortuneMaterials, HaveADiffuseAndAGlossyLobe) {
  for (const char* name : {"bluepaint", "clay", "felt", "primer", "skin"}) {
    const auto material = plugins_.MakeMaterial("\"" + std::string(name) + "\"");
    EXPECT_EQ(material->PossibleLobes(), LobeSet::NonSpecularReflection) << name;
    EXPECT_EQ(material->LobeCount(), 2);
    EXPECT_EQ(Evaluate(name).Count(LobeSet::DiffuseReflection), 1);
    EXPECT_EQ(Evaluate(name).Count(LobeSet::GlossyReflection), 1);
  }
  EXPECT_EQ(plugins_.MakeMaterial("\"brushedmetal\"")->PossibleLobes(), LobeSet::GlossyReflection);
  EXPECT_FALSE(plugins_.MakeMaterial("\"skin\" \"float bumpmap\" .1")->NeedsDifferentials());
}

// The weight of a sample is at most the sum of the lobes' integrals times the cosine. For one
// lobe with equal channels it is a third of 2 pi / (n + 1) times three.
TEST(Lafortune, SampleOfOneLobeHasAWeightProportionalToTheCosine) {
  const LafortuneFit fit{{Spectrum(-1), Spectrum(1), Spectrum(9)}};
  const Lafortune lobe(fit);
  RandomStream random(5);
  for (int i = 0; i < 500; ++i) {
    const auto sample =
        lobe.Sample({Real(.28), 0, Real(.96)}, {random.Uniform(), random.Uniform()});
    ASSERT_TRUE(sample);
    EXPECT_GT(sample->wi.z, 0);
    EXPECT_LE(double(sample->throughput.g), 2 * M_PI / 10 * double(sample->wi.z) * 1.001);
  }
}

TEST(Lafortune, WithoutLightForADirectionMakesNoSample) {
  const LafortuneFit fit{{Spectrum(-1), Spectrum(-1), Spectrum(9)}};
  const Lafortune lobe(fit);
  EXPECT_FALSE(lobe.Sample({0, 0, 1}, {Real(.3), Real(.4)}));
  EXPECT_EQ(lobe.Pdf({0, 0, 1}, {Real(.6), 0, Real(.8)}), 0);
  EXPECT_TRUE(lobe.f({0, 0, 1}, {Real(.6), 0, Real(.8)}).IsBlack());
  EXPECT_TRUE(lobe.Sample({Real(.8), 0, Real(.6)}, {Real(.3), Real(.4)}));
}

}  // namespace
}  // namespace exphoton
