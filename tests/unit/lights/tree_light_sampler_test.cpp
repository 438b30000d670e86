// SPDX-License-Identifier: BSD-2-Clause
// These tests check TreeLightSampler. Its probabilities must match its choices, sum to 1, and be
// positive for every light that may emit. Pictures with many lights must have the same mean as with
// every light sampled.
#include "core/lights/selection/tree_light_sampler.h"

#include <gtest/gtest.h>

#include "core/math/sampling/random.h"
#include "tests/support/equivalence.h"
#include "tests/support/placed_light.h"
#include "tests/support/test_scene.h"

namespace exphoton {
namespace {

const Sphere3 kTreeWorld{{0, 0, 0}, 10};

using TreeLights = std::vector<std::unique_ptr<Light>>;

TreeLights Scattered(int count) {
  TreeLights lights;
  RandomStream random(5);
  for (int i = 0; i < count; ++i) {
    const Real x = random.Uniform(), y = random.Uniform();
    lights.push_back(
        std::make_unique<PlacedLight>(Point3{10 * x, 10 * y, random.Uniform()}, random.Uniform()));
  }
  return lights;
}

// Each light has an interval of u, so the light is chosen as often as its probability states.
TEST(TreeLightSampler, ChoosesWithTheProbabilitiesThatItGives) {
  TreeLights lights = Scattered(37);
  lights.push_back(std::make_unique<PlacedLight>(std::nullopt, Real(500)));
  lights.push_back(std::make_unique<PlacedLight>(std::nullopt, Real(100)));
  lights.push_back(std::make_unique<PlacedLight>(Point3{5, 5, 0}, Real(9), true));
  const TreeLightSampler tree(lights, kTreeWorld);
  for (const LightReceiver& p :
       {LightReceiver({5, 5, 0}), LightReceiver({-40, 2, 3}), LightReceiver({1, 9, .5f}),
        LightReceiver({5, 5, 0}, {0, 0, 1}, {0, .6f, .8f}),
        LightReceiver({3, 9, .5f}, {-.6f, -.8f, 0}, {-1, 0, 0}),
        LightReceiver({3, 9, .5f}, {}, {-1, 0, 0})}) {
    const LightReceiver prepared = tree.Prepared(p);
    std::vector<double> found(lights.size(), 0.0);
    constexpr int kSteps = 200000;
    for (int i = 0; i < kSteps; ++i) {
      const auto choice = tree.Sample(p, Real((i + .5) / kSteps));
      found[std::size_t(choice.index)] += 1.0 / kSteps;
      ASSERT_NEAR(choice.probability / tree.Pmf(p, *choice.light), 1, 1e-5);
      ASSERT_EQ(choice.probability, tree.Sample(prepared, Real((i + .5) / kSteps)).probability);
    }
    double sum = 0;
    for (std::size_t i = 0; i < lights.size(); ++i) {
      const double probability = double(tree.Pmf(p, *lights[i]));
      EXPECT_NEAR(found[i], probability, 2e-5) << i;
      EXPECT_EQ(probability > 0, i + 1 < lights.size()) << i;
      sum += probability;
    }
    EXPECT_NEAR(sum, 1, 1e-6);
  }
}

TEST(TreeLightSampler, PrefersWhatIsNear) {
  TreeLights lights;
  for (int i = 0; i < 100; ++i)
    lights.push_back(std::make_unique<PlacedLight>(Point3{Real(i), 0, 0}, Real(1)));
  const TreeLightSampler tree(lights, kTreeWorld);
  const Point3 p{20, Real(.5), 0};
  EXPECT_GT(tree.Pmf(p, *lights[20]), .1);
  EXPECT_LT(tree.Pmf(p, *lights[90]), .003);
}

TEST(TreeLightSampler, StarvesNoLightOfUnknownPowerAndStandsPointsOnLights) {
  TreeLights lights;
  for (int i = 0; i < 5; ++i)  // all at the same point
    lights.push_back(std::make_unique<PlacedLight>(Point3{1, 1, 1}, i == 0 ? Real(0) : Real(1e30)));
  lights.push_back(std::make_unique<PlacedLight>(std::nullopt, Real(0)));
  const TreeLightSampler tree(lights, kTreeWorld);
  for (const Point3 p : {Point3{1, 1, 1}, Point3{2, 3, 4}}) {
    double sum = 0;
    for (int i = 0; i < 6; ++i) {
      EXPECT_GT(tree.Pmf(p, *lights[std::size_t(i)]), 1e-4) << i;
      sum += double(tree.Pmf(p, *lights[std::size_t(i)]));
    }
    EXPECT_NEAR(sum, 1, 1e-6);
  }
  EXPECT_TRUE(TreeLightSampler(TreeLights(), kTreeWorld).IsEmpty());
}

// Returns a floor with 81 small lamps behind the camera, 8 point lights and a sky.
std::string ManyLamps(const std::string& integrator) {
  std::string text = TestHeader(integrator, 12, 12, 16) +
                     "WorldBegin\nLightSource \"infinite\" \"color L\" [.1 .1 .1]\n";
  for (int i = 0; i < 8; ++i)
    text += "LightSource \"point\" \"color I\" [.3 .2 .1] \"point from\" [" +
            std::to_string(.5 * i - 2) + " -1.5 3]\n";
  for (int i = 0; i < 81; ++i)
    text += "AttributeBegin Translate " + std::to_string(.5 * (i % 9) - 2) + " 2 " +
            std::to_string(.5 * double(i / 9) - 4.5) + " AreaLightSource \"area\" \"color L\" [" +
            std::to_string(1 + i % 3) + " 1 1] Shape \"sphere\" \"float radius\" .1 AttributeEnd\n";
  return text +
         "Material \"plastic\" \"color Kd\" [.4 .4 .4] \"float roughness\" .05\nTranslate 0 0 4 "
         "Shape \"trianglemesh\" \"integer indices\" [0 1 2 0 2 3] \"point P\" [-4 -2 0 4 -2 0 4 2 "
         "1 -4 2 1]\nWorldEnd\n";
}

// Compares the mean over seeds for another way of choosing lights with the mean for all lights.
void ExpectTheMeanOfAllLights(const std::string& integrator) {
  TestRenderOptions options;
  options.load.samplesPerPixel = 64;
  const double truth = MeanRadiance(
      RenderSceneText(ManyLamps("\"directlighting\" \"integer maxdepth\" 0"), options).image);
  std::vector<double> means;
  for (options.seed = 2; options.seed < 10; ++options.seed) {
    options.load.samplesPerPixel = 256;
    means.push_back(MeanRadiance(RenderSceneText(ManyLamps(integrator), options).image));
  }
  EXPECT_TRUE(IsWithin(.01, EstimateFrom(means), truth));
}

TEST(ManyLights, HaveTheMeanOfAllLightsByOneSampleAPoint) {
  ExpectTheMeanOfAllLights(
      "\"directlighting\" \"integer maxdepth\" 0 \"string strategy\" \"near\"");
}

TEST(ManyLights, HaveTheMeanOfAllLightsInThePhotonIntegrators) {
  ExpectTheMeanOfAllLights(
      "\"exphotonmap\" \"integer maxdepth\" 0 \"integer directlights\" 8 \"integer "
      "indirectphotons\" "
      "0 \"integer causticphotons\" 0 \"bool finalgather\" \"false\"");
}

TEST(ManyLights, HaveTheMeanOfAllLightsInPathTracing) {
  ExpectTheMeanOfAllLights("\"path\" \"integer maxdepth\" 0");
}

}  // namespace
}  // namespace exphoton
