// SPDX-License-Identifier: BSD-2-Clause
// These tests check that LightDistribution returns true probabilities and gives every light that
// may emit a minimum probability.
#include <gtest/gtest.h>

#include "core/lights/light_distribution.h"
#include "tests/support/placed_light.h"

namespace exphoton {
namespace {

std::vector<std::unique_ptr<Light>> Lights(std::initializer_list<Real> powers) {
  std::vector<std::unique_ptr<Light>> lights;
  // A negative number makes a light that is provably black.
  for (const Real p : powers)
    lights.push_back(std::make_unique<PlacedLight>(std::nullopt, std::max(p, Real(0)), p < 0));
  return lights;
}

TEST(LightDistribution, ProbabilitiesOfEqualLightsAreOneOverTheirNumber) {
  const auto lights = Lights({3, 3, 3, 3});
  const LightDistribution distribution(lights, LightSelection::Power);
  for (int i = 0; i < 4; ++i) EXPECT_NEAR(double(distribution.Probability(i)), .25, 1e-6);
}

TEST(LightDistribution, FollowsPowerWithAUniformShare) {
  const auto lights = Lights({1, 3});
  const LightDistribution distribution(lights, LightSelection::Power);
  const double share = LightDistribution::kUniformShare;
  EXPECT_NEAR(double(distribution.Probability(0)), (1 - share) * .25 + share * .5, 1e-6);
  const LightDistribution uniform(lights, LightSelection::Uniform);
  EXPECT_NEAR(double(uniform.Probability(0)), .5, 1e-6);
}

TEST(LightDistribution, NeverStarvesALightWhosePowerIsUnderestimated) {
  const auto lights = Lights({0, 5, kInfinity});
  const LightDistribution distribution(lights, LightSelection::Power);
  for (int i = 0; i < 3; ++i)
    EXPECT_GE(double(distribution.Probability(i)), LightDistribution::kUniformShare / 3 - 1e-6);
}

TEST(LightDistribution, NeverChoosesABlackLight) {
  const auto lights = Lights({-1, 5, -1, 2, -1});
  const LightDistribution distribution(lights, LightSelection::Power);
  for (const Real u : {Real(0), Real(.3), Real(.9), kOneMinusEpsilon}) {
    const auto choice = distribution.Sample(u);
    EXPECT_TRUE(choice.index == 1 || choice.index == 3);
    EXPECT_EQ(choice.light, lights[std::size_t(choice.index)].get());
    EXPECT_EQ(choice.probability, distribution.Probability(choice.index));
    EXPECT_LT(choice.remapped, 1);
  }
  EXPECT_EQ(distribution.Probability(0), 0);
}

TEST(LightDistribution, SharesTheUniformPartAmongLightsThatShine) {
  const auto lights = Lights({1, -1, 3, -1});
  const LightDistribution distribution(lights, LightSelection::Power);
  const double share = LightDistribution::kUniformShare;
  EXPECT_NEAR(double(distribution.Probability(0)), (1 - share) * .25 + share * .5, 1e-6);
  EXPECT_NEAR(double(distribution.Probability(2)), (1 - share) * .75 + share * .5, 1e-6);
}

TEST(LightDistribution, OfBlackLightsOnlyIsEmpty) {
  EXPECT_TRUE(LightDistribution(Lights({-1, -1}), LightSelection::Power).IsEmpty());
  EXPECT_TRUE(LightDistribution(Lights({}), LightSelection::Uniform).IsEmpty());
}

TEST(LightDistribution, WithoutAnyKnownPowerIsUniform) {
  const auto lights = Lights({0, 0});
  const LightDistribution distribution(lights, LightSelection::Power);
  EXPECT_NEAR(double(distribution.Probability(0)), .5, 1e-6);
}

}  // namespace
}  // namespace exphoton
