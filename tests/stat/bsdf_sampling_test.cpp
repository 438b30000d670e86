// SPDX-License-Identifier: BSD-2-Clause
// These chi-square tests compare sampled directions with Pdf, for every smooth lobe and every
// material. The false-alarm rate is 1 % over all tests of this file.
#include <fstream>

#include "core/base/arena.h"
#include "tests/support/chi_square.h"
#include "tests/support/scattering.h"
#include "tests/support/test_plugin.h"

namespace exphoton {
namespace {

constexpr int kTests = 400;
const std::vector<Real> kCosines{1,          Real(.9),   Real(.5),   Real(.2),  Real(.1),
                                 Real(1e-2), Real(1e-3), Real(1e-6), Real(-.7), -1};

class LobeSampling : public testing::TestWithParam<NamedLobe> {};
INSTANTIATE_TEST_SUITE_P(All, LobeSampling, testing::ValuesIn(SmoothLobes()),
                         [](const auto& info) { return info.param.name; });

TEST_P(LobeSampling, FollowsItsDensityFromEveryDirection) {
  const Bxdf& lobe = *GetParam().lobe;
  for (const Vector3& wo : Directions(kCosines)) {
    const auto sample = [&](RandomStream& random) -> std::optional<Vector3> {
      const Real x = random.Uniform(), y = random.Uniform();
      const auto found = lobe.Sample(wo, {x, y});
      if (!found) return std::nullopt;
      return OffHorizon(found->wi);
    };
    const auto pdf = [&](const Vector3& wi) { return double(lobe.Pdf(wo, wi)); };
    ChiSquareOptions options;
    options.samples = 30000;
    EXPECT_TRUE(FitsDensity(TestDirections({}, sample, pdf, options), kTests)) << "cos wo " << wo.z;
  }
}

struct MaterialCase {
  std::string name, text;
  friend void PrintTo(const MaterialCase& c, std::ostream* out) { *out << c.text; }
};
// Writes samples of a glossy lobe over a diffuse one to a file of measurements.
std::string WriteGlossySamples() {
  const std::string path = testing::TempDir() + "exphoton_glossy_samples.brdf";
  std::ofstream file(path);
  file << "1 550\n";
  for (int i = 0; i <= 8; ++i) {
    for (int o = 0; o <= 8; ++o) {
      for (int a = 0; a <= 8; ++a) {
        const double ti = i * .19, to = o * .19, azimuth = a * M_PI / 8;
        const double x = std::sin(ti) + std::sin(to) * std::cos(azimuth);
        const double y = std::sin(to) * std::sin(azimuth), z = std::cos(ti) + std::cos(to);
        const double gloss = std::pow(z / std::sqrt(x * x + y * y + z * z), 60);
        file << ti << " 0 " << to << ' ' << azimuth << ' ' << .1 + 2 * gloss << '\n';
      }
    }
  }
  return path;
}

std::vector<MaterialCase> Materials() {
  return {{"matte", R"("matte" "color Kd" [.5 .6 .7])"},
          {"matteRough", R"("matte" "float sigma" 40)"},
          {"plastic", R"("plastic" "float roughness" .05)"},
          {"plasticPhysical", R"("plastic" "string fresnel" "physical")"},
          {"shinymetal", R"("shinymetal" "color Ks" [.5 .5 .5] "color Kr" [.3 .3 .3])"},
          {"metal", R"("metal" "float roughness" .02)"},
          {"substrate", R"("substrate" "float uroughness" .01 "float vroughness" .2)"},
          {"translucent", R"("translucent" "color transmit" [.3 .3 .3])"},
          {"bluepaint", R"("bluepaint")"},
          {"brushedmetal", R"("brushedmetal")"},
          {"clay", R"("clay")"},
          {"felt", R"("felt")"},
          {"primer", R"("primer")"},
          {"skin", R"("skin")"},
          {"measured", "\"measured\" \"string filename\" \"" + WriteGlossySamples() + "\""},
          {"uberRefracting", R"("uber" "color Kt" [.5 .5 .5] "float index" 1.3)"},
          {"uber", R"("uber" "color Kr" [.3 .3 .3] "color opacity" [.6 .6 .6])"}};
}

class MaterialSampling : public testing::TestWithParam<MaterialCase> {
 protected:
  // Checks smooth samples under the mask, in world space, on a surface whose shading normal differs
  // from its geometric normal.
  void Check(LobeSet mask, Real tilt) {
    TestPlugins plugins;
    const auto material = plugins.MakeMaterial(GetParam().text);
    Arena arena;
    SurfaceInteraction si = TiltedSurface(tilt);
    const Bsdf bsdf = material->Evaluate(&si, TransportMode::Radiance, &arena);
    for (const Vector3& wo : Directions({Real(.9), Real(.3), Real(1e-2), Real(-.5)})) {
      const auto sample = [&](RandomStream& random) -> std::optional<Vector3> {
        const Real x = random.Uniform(), y = random.Uniform();
        const auto found = bsdf.Sample(wo, {x, y}, random.Uniform(), mask);
        if (!found || found->IsSpecular()) return std::nullopt;
        return OffHorizon(found->wi);
      };
      const auto pdf = [&](const Vector3& wi) { return double(bsdf.Pdf(wo, wi, mask)); };
      ChiSquareOptions options;
      options.samples = 20000;
      options.quadratureDepth = 6;
      EXPECT_TRUE(FitsDensity(TestDirections({}, sample, pdf, options), kTests))
          << "cos wo " << wo.z;
    }
  }
};
// Samples of photons must stay within the bound of the material, specular ones too. The lobe of
// measurements knows none.
TEST_P(MaterialSampling, StaysWithinItsThroughputBound) {
  TestPlugins plugins;
  const auto material = plugins.MakeMaterial(GetParam().text);
  Arena arena;
  SurfaceInteraction si = TiltedSurface(0);
  const Bsdf bsdf = material->Evaluate(&si, TransportMode::Importance, &arena);
  RandomStream random(5);
  for (const LobeSet mask : {LobeSet::All, LobeSet::NonSpecular}) {
    for (const Vector3& wo : Directions({1, Real(.8), Real(.3), Real(1e-2), Real(-.5)})) {
      const auto bound = bsdf.ThroughputBound(wo, mask);
      ASSERT_EQ(bound.has_value(), GetParam().name != "measured");
      if (!bound) return;
      for (int i = 0; i < 4000; ++i) {
        const Point2 u{random.Uniform(), random.Uniform()};
        const auto sample = bsdf.Sample(wo, u, random.Uniform(), mask, TransportMode::Importance);
        if (!sample) continue;
        for (int c = 0; c < 3; ++c)
          ASSERT_LE(sample->throughput[c], (*bound)[c] * Real(1.001)) << "cos wo " << wo.z;
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(All, MaterialSampling, testing::ValuesIn(Materials()),
                         [](const auto& info) { return info.param.name; });

TEST_P(MaterialSampling, FollowsItsDensity) { Check(LobeSet::All, 0); }
TEST_P(MaterialSampling, FollowsItsDensityUnderASmoothMask) { Check(LobeSet::NonSpecular, 0); }
TEST_P(MaterialSampling, FollowsItsDensityUnderATiltedNormal) { Check(LobeSet::All, Real(.4)); }

}  // namespace
}  // namespace exphoton
