// SPDX-License-Identifier: BSD-2-Clause
// These tests hold every LightSampler to its interface: probabilities that sum to 1, choices that
// occur with these probabilities, no choice of a black light, and a uniform remapped variate. They
// also check which implementation the factory makes.
#include "core/lights/selection/light_sampler.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "core/lights/selection/light_selection.h"
#include "core/math/sampling/random.h"
#include "tests/support/placed_light.h"

namespace exphoton {
namespace {

using LightList = std::vector<std::unique_ptr<Light>>;

const Sphere3 kSampledWorld{{0, 0, 0}, 10};
const std::array<Point3, 3> kPoints{Point3{5, 5, 0}, Point3{-40, 2, 3}, Point3{1, 9, Real(.5)}};

// Returns `count` lights that are not black, of random places and powers, and two black lights. The
// first light and the last are black. Two lights are distant if there are at least ten.
LightList RandomLights(int count) {
  LightList lights;
  RandomStream random(7);
  const auto add = [&](std::optional<Point3> place, Real power, bool isBlack) {
    lights.push_back(std::make_unique<PlacedLight>(place, power, isBlack));
  };
  add(Point3{1, 1, 1}, 3, true);
  for (int i = 0; i < count; ++i) {
    const Real x = random.Uniform(), y = random.Uniform(), z = random.Uniform();
    const bool isDistant = count >= 10 && (i == 4 || i == 9);
    const Real power = Real(.2) + random.Uniform();
    add(isDistant ? std::nullopt : std::optional<Point3>(Point3{10 * x, 10 * y, z}),
        isDistant ? 300 * power : power, false);
  }
  add(std::nullopt, 5, true);
  return lights;
}

// The parameters are a selection and a number of lights that are not black.
class EveryLightSampler : public testing::TestWithParam<std::tuple<LightSelection, int>> {
 protected:
  LightList lights_ = RandomLights(std::get<1>(GetParam()));
  std::unique_ptr<const LightSampler> sampler_ =
      MakeLightSampler(lights_, kSampledWorld, std::get<0>(GetParam()));
};

TEST_P(EveryLightSampler, HasProbabilitiesThatSumToOne) {
  for (const Point3& p : kPoints) {
    double sum = 0;
    for (const auto& light : lights_) sum += double(sampler_->Pmf(p, *light));
    EXPECT_NEAR(sum, 1, 1e-5);
  }
}

TEST_P(EveryLightSampler, GivesABlackLightNoProbability) {
  ASSERT_FALSE(sampler_->IsEmpty());
  for (const Point3& p : kPoints) {
    EXPECT_EQ(sampler_->Pmf(p, *lights_.front()), 0);
    EXPECT_EQ(sampler_->Pmf(p, *lights_.back()), 0);
    for (std::size_t i = 1; i + 1 < lights_.size(); ++i)
      EXPECT_GT(sampler_->Pmf(p, *lights_[i]), 0) << i;
  }
}

// u takes the middle of each of kSteps equal strata. Each light has one interval of u, so its
// number of choices is exact up to the two ends of the interval, and its remapped variates are
// evenly spaced over [0,1).
TEST_P(EveryLightSampler, ChoosesByItsProbabilitiesAndRemapsUniformly) {
  constexpr int kSteps = 1 << 18;
  for (const Point3& p : kPoints) {
    std::vector<std::vector<double>> remapped(lights_.size());
    for (int i = 0; i < kSteps; ++i) {
      const auto choice = sampler_->Sample(p, Real((i + .5) / kSteps));
      ASSERT_EQ(choice.light, lights_[std::size_t(choice.index)].get());
      ASSERT_NEAR(double(choice.probability) / double(sampler_->Pmf(p, *choice.light)), 1, 1e-5);
      ASSERT_GE(choice.remapped, 0);
      ASSERT_LT(choice.remapped, 1);
      remapped[std::size_t(choice.index)].push_back(double(choice.remapped));
    }
    for (std::size_t i = 0; i < lights_.size(); ++i) {
      const auto count = double(remapped[i].size());
      EXPECT_NEAR(count / kSteps, double(sampler_->Pmf(p, *lights_[i])), 2.0 / kSteps) << i;
      for (std::size_t j = 0; j < remapped[i].size(); ++j)
        ASSERT_NEAR(remapped[i][j], (double(j) + .5) / count, 2 / count + 1e-6) << i << ' ' << j;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(
    Selections, EveryLightSampler,
    testing::Combine(testing::Values(LightSelection::Uniform, LightSelection::Power,
                                     LightSelection::HalfPower, LightSelection::Tree,
                                     LightSelection::Auto),
                     testing::Values(1, 2, 15, 16, 40)));

TEST(LightSelection, UsesTheTreeFromSixteenLightsThatAreNotBlack) {
  const auto dependsOnPoint = [](int count, LightSelection selection) {
    const LightList lights = RandomLights(count);
    const auto sampler = MakeLightSampler(lights, kSampledWorld, selection);
    return sampler->Pmf(kPoints[0], *lights[1]) != sampler->Pmf(kPoints[1], *lights[1]);
  };
  EXPECT_FALSE(dependsOnPoint(15, LightSelection::Auto));
  EXPECT_TRUE(dependsOnPoint(16, LightSelection::Auto));
  EXPECT_TRUE(dependsOnPoint(2, LightSelection::Tree));
  for (const LightSelection selection :
       {LightSelection::Uniform, LightSelection::Power, LightSelection::HalfPower})
    EXPECT_FALSE(dependsOnPoint(40, selection));
}

TEST(LightSelection, MixesPowerWithAUniformShare) {
  LightList lights;
  lights.push_back(std::make_unique<PlacedLight>(std::nullopt, Real(1)));
  lights.push_back(std::make_unique<PlacedLight>(std::nullopt, Real(3)));
  const auto first = [&](LightSelection selection) {
    return double(MakeLightSampler(lights, kSampledWorld, selection)->Pmf(kPoints[0], *lights[0]));
  };
  EXPECT_NEAR(first(LightSelection::Uniform), .5, 1e-6);
  EXPECT_NEAR(first(LightSelection::Power), .95 * .25 + .05 * .5, 1e-6);
  EXPECT_NEAR(first(LightSelection::HalfPower), .5 * .25 + .5 * .5, 1e-6);
  EXPECT_NEAR(first(LightSelection::Auto), first(LightSelection::HalfPower), 1e-6);
}

TEST(LightSelection, ScalesThePowerOfLightsThatPhotonsLeave) {
  LightList lights;
  lights.push_back(std::make_unique<PlacedLight>(std::nullopt, Real(4)));
  lights.push_back(std::make_unique<PlacedLight>(std::nullopt, Real(3)));
  const double factors[] = {.25, 1};
  const auto sampler = MakeEmissionLightSampler(lights, LightSelection::Power, factors);
  EXPECT_NEAR(double(sampler->Pmf(*lights[0])), .95 * .25 + .05 * .5, 1e-6);
}

TEST(LightSelection, OfBlackLightsIsEmpty) {
  for (const LightSelection selection :
       {LightSelection::Uniform, LightSelection::Power, LightSelection::Tree}) {
    const LightList lights = RandomLights(0);
    const auto sampler = MakeLightSampler(lights, kSampledWorld, selection);
    EXPECT_TRUE(sampler->IsEmpty());
    EXPECT_EQ(sampler->Pmf(kPoints[0], *lights[0]), 0);
    EXPECT_TRUE(MakeLightSampler(LightList(), kSampledWorld, selection)->IsEmpty());
  }
}

}  // namespace
}  // namespace exphoton
