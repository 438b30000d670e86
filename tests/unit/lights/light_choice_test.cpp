// SPDX-License-Identifier: BSD-2-Clause
// These tests compare the probabilities of light choices with closed forms: the two levels of the
// light tree, and the number of lights from which path tracing uses it.
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/lights/selection/tree_light_sampler.h"
#include "core/scene/scene.h"
#include "tests/support/placed_light.h"
#include "tests/support/test_scene.h"

namespace exphoton {
namespace {

using LightList = std::vector<std::unique_ptr<Light>>;

LightList Make(const std::vector<std::pair<std::optional<Point3>, Real>>& places) {
  LightList lights;
  for (const auto& [place, power] : places)
    lights.push_back(std::make_unique<PlacedLight>(place, power));
  return lights;
}

// Each light's power is mixed with 5 % of the mean power. Of two lights, each is chosen in
// proportion to its mixed power over its squared distance.
TEST(LightChoice, OfTwoLightsIsByPowerOverSquaredDistance) {
  const LightList lights = Make({{Point3{0, 0, 0}, Real(2)}, {Point3{4, 0, 0}, Real(10)}});
  const TreeLightSampler tree(lights, {{0, 0, 0}, 10});
  const double near = .95 * 2 + .05 * 6, far = .95 * 10 + .05 * 6;
  for (const Point3 p : {Point3{1, 2, 0}, Point3{-3, 0, 5}, Point3{4, 1, 0}}) {
    const double a = near / double(LengthSquared(p - Point3{0, 0, 0}));
    const double b = far / double(LengthSquared(p - Point3{4, 0, 0}));
    EXPECT_NEAR(double(tree.Pmf(p, *lights[0])), a / (a + b), 1e-5);
    EXPECT_NEAR(double(tree.Pmf(p, *lights[1])), b / (a + b), 1e-5);
  }
  // No child is chosen with less than one thousandth.
  EXPECT_NEAR(double(tree.Pmf(Point3{4, 0, 0}, *lights[0])), 1e-3, 1e-6);
  EXPECT_NEAR(double(tree.Pmf(Point3{0, Real(1e-4), 0}, *lights[1])), 1e-3, 1e-6);
}

// A group of lights counts by its whole power. Within the sphere round its box the distance is the
// radius of the sphere.
TEST(LightChoice, OfAGroupIsAtLeastItsRadiusAway) {
  const LightList lights = Make({{Point3{0, 0, 0}, Real(1)},
                                 {Point3{0, 2, 0}, Real(1)},
                                 {Point3{10, 0, 0}, Real(1)},
                                 {Point3{10, 2, 0}, Real(1)}});
  const TreeLightSampler tree(lights, {{0, 0, 0}, 20});
  const auto group = [&](const Point3& p) {
    return double(tree.Pmf(p, *lights[0])) + double(tree.Pmf(p, *lights[1]));
  };
  // Both centres are at y = 1; both radii are 1.
  for (const Point3 p : {Point3{2, 1, 0}, Point3{4, 7, 1}, Point3{9, -3, 2}}) {
    const double a = 1 / double(LengthSquared(p - Point3{0, 1, 0}));
    const double b = 1 / double(LengthSquared(p - Point3{10, 1, 0}));
    EXPECT_NEAR(group(p), a / (a + b), 1e-5);
  }
  const Point3 inside{0, Real(1.25), 0};
  const double b = 1 / double(LengthSquared(inside - Point3{10, 1, 0}));
  EXPECT_NEAR(group(inside), 1 / (1 + b), 1e-5);
  const double c = 1 / (1.25 * 1.25), d = 1 / (.75 * .75);
  EXPECT_NEAR(double(tree.Pmf(inside, *lights[0])) / group(inside), c / (c + d), 1e-5);
}

// A receiver with a normal counts the cosine of the light, too. A light behind the surface keeps
// the least probability.
TEST(LightChoice, OfTwoLightsIsByTheCosineAtTheSurface) {
  const LightList lights = Make({{Point3{0, 0, 0}, Real(2)}, {Point3{4, 0, 0}, Real(2)}});
  const TreeLightSampler tree(lights, {{0, 0, 0}, 10});
  const Normal3 n = Normalize(Normal3{1, 1, 0});
  const Point3 p{1, -2, 0};
  const double a = (-1 + 2) / std::pow(5., 1.5), b = (3 + 2) / std::pow(13., 1.5);
  EXPECT_NEAR(double(tree.Pmf({p, n, n}, *lights[0])), a / (a + b), 1e-5);
  EXPECT_NEAR(double(tree.Pmf({p, n, n}, *lights[1])), b / (a + b), 1e-5);
  EXPECT_NEAR(double(tree.Pmf({p, {-1, 0, 0}, {-1, 0, 0}}, *lights[1])), 1e-3, 1e-6);
}

// The cosine of a group is a bound: no point within the sphere round its box is higher above the
// surface than the centre plus the radius.
TEST(LightChoice, OfAGroupIsByABoundOnTheCosine) {
  const LightList lights = Make({{Point3{0, -1, 0}, Real(1)},
                                 {Point3{0, 1, 0}, Real(1)},
                                 {Point3{10, -1, 0}, Real(1)},
                                 {Point3{10, 1, 0}, Real(1)}});
  const TreeLightSampler tree(lights, {{0, 0, 0}, 20});
  const Point3 p{4, 0, 0};
  for (const double degrees : {20., 85., 100., 170.}) {
    const double angle = degrees / 180 * M_PI;  // between the normal and the second group
    const Normal3 n{Real(std::cos(angle)), 0, Real(std::sin(angle))};
    const auto bound = [](double cosine, double distance) {
      if (cosine < -1 / distance) return 0.;
      return std::min(std::abs(cosine) + 1 / distance, 1.);
    };
    const double a = bound(-std::cos(angle), 4) / 16, b = bound(std::cos(angle), 6) / 36;
    const LightReceiver receiver{p, n, n};
    const double found =
        double(tree.Pmf(receiver, *lights[2])) + double(tree.Pmf(receiver, *lights[3]));
    EXPECT_NEAR(found, std::clamp(b / (a + b), 1e-3, 1 - 1e-3), 1e-5) << degrees;
  }
}

// The geometric normal decides whether a light is behind the surface, the shading normal gives the
// cosine.
TEST(LightChoice, CountsTheCosineOfTheShadingNormalOnTheTrueSide) {
  const LightList lights = Make({{Point3{4, 1, 0}, Real(1)}, {Point3{-4, 1, 0}, Real(1)}});
  const TreeLightSampler tree(lights, {{0, 0, 0}, 10});
  const Normal3 tilted{Real(.8), Real(.6), 0};
  const double a = .8 * 4 + .6, b = .8 * 4 - .6;  // the second is behind the shading normal
  EXPECT_NEAR(double(tree.Pmf({{}, {0, 1, 0}, tilted}, *lights[0])), a / (a + b), 1e-5);
  EXPECT_NEAR(double(tree.Pmf({{}, {0, 1, 0}, -tilted}, *lights[0])), a / (a + b), 1e-5);
  EXPECT_NEAR(double(tree.Pmf({{}, tilted, tilted}, *lights[0])), 1 - 1e-3, 1e-5);
}

// The tree counts by its irradiance, power / (4 pi d^2), and the distant lights by power over the
// area of the world's disk. Each of both has a probability of at least .1.
TEST(LightChoice, OfDistantLightsIsByIrradiance) {
  const Sphere3 world{{0, 0, 0}, 10};
  const LightList lights =
      Make({{Point3{0, 0, 0}, Real(50)}, {std::nullopt, Real(300)}, {std::nullopt, Real(900)}});
  const TreeLightSampler tree(lights, world);
  const double disk = M_PI * 100, far = 1200 / disk;
  for (const Real distance : {Real(1), Real(2), Real(3)}) {
    const Point3 p{0, distance, 0};
    const double near = 50 / (4 * M_PI * double(distance) * double(distance));
    const double all = std::clamp(far / (far + near), .1, .9);
    EXPECT_NEAR(double(tree.Pmf(p, *lights[0])), 1 - all, 1e-5);
    EXPECT_NEAR(double(tree.Pmf(p, *lights[1])), all * (.95 * .25 + .05 * .5), 1e-5);
    EXPECT_NEAR(double(tree.Pmf(p, *lights[2])), all * (.95 * .75 + .05 * .5), 1e-5);
  }
  EXPECT_NEAR(double(tree.Pmf(Point3{0, Real(.1), 0}, *lights[0])), .9, 1e-6);
  EXPECT_NEAR(double(tree.Pmf(Point3{0, 1000, 0}, *lights[0])), .1, 1e-6);
}

// The tree's irradiance is the sum of a few groups: those beside the way to the brightest light.
TEST(LightChoice, OfDistantLightsSeesALampThatIsNearInAWideScene) {
  const Sphere3 world{{0, 0, 0}, 1000};
  const LightList lights =
      Make({{Point3{0, 0, 0}, Real(50)}, {Point3{900, 0, 0}, Real(50)}, {std::nullopt, Real(3e6)}});
  const TreeLightSampler tree(lights, world);
  const double far = 3e6 / (M_PI * 1e6), near = 50 / (4 * M_PI * 4) + 50 / (4 * M_PI * 810004);
  EXPECT_NEAR(double(tree.Pmf(Point3{0, 2, 0}, *lights[2])), far / (far + near), 1e-5);
  // From a surface that faces away from the lamps, the sky remains.
  EXPECT_NEAR(double(tree.Pmf({{0, 2, 0}, {0, 1, 0}, {0, 1, 0}}, *lights[2])), .9, 1e-6);
}

LoadedScene RowOfLamps(int count) {
  std::string text = "WorldBegin\n";
  for (int i = 0; i < count; ++i)
    text += "LightSource \"point\" \"color I\" [" + std::to_string(i + 1) +
            " 1 1] \"point from\" [" + std::to_string(2 * i) + " 0 0]\n";
  return LoadSceneText(text +
                       "LightSource \"point\" \"color I\" [0 0 0]\nShape \"sphere\"\n"
                       "WorldEnd\n");
}

// Up to 15 lights the choice is by power, half of it uniform, wherever the point is. From 16 on it
// depends on the point.
TEST(LightChoice, OfAPathIsByTheTreeFromSixteenLightsOn) {
  for (const int count : {15, 16}) {
    const LoadedScene loaded = RowOfLamps(count);
    const Scene& scene = *loaded.setup->scene;
    const auto sampler = scene.MakeLightSampler(LightSelection::Auto);
    const Light& first = *scene.Lights()[0];
    const Point3 near{0, 1, 0}, away{99, 1, 0};
    const bool isTree = sampler->Pmf(near, first) != sampler->Pmf(away, first);
    EXPECT_EQ(isTree, count >= 16) << count;
    double sum = 0, power = 0;
    for (const auto& light : scene.Lights()) {
      sum += double(sampler->Pmf(near, *light));
      power += double(light->Power().Y());
    }
    EXPECT_NEAR(sum, 1, 1e-5);
    if (count == 15) {
      EXPECT_NEAR(double(sampler->Pmf(near, first)),
                  .5 * double(first.Power().Y()) / power + .5 / 15, 1e-6);
    }
    const auto choice = sampler->Sample(near, Real(.4));
    EXPECT_EQ(choice.light, scene.Lights()[std::size_t(choice.index)].get());
    EXPECT_NEAR(double(choice.probability), double(sampler->Pmf(near, *choice.light)), 1e-6);
    EXPECT_EQ(sampler->Pmf(near, *scene.Lights().back()), 0) << "it is black";
  }
}

}  // namespace
}  // namespace exphoton
