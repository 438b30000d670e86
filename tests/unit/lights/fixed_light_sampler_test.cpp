// SPDX-License-Identifier: BSD-2-Clause
// These tests check the probabilities of UniformLightSampler and PowerLightSampler. Every light
// that may emit has a minimum probability.
#include "core/lights/selection/fixed_light_sampler.h"

#include <gtest/gtest.h>

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

TEST(FixedLightSampler, ProbabilitiesOfEqualLightsAreOneOverTheirNumber) {
  const auto lights = Lights({3, 3, 3, 3});
  const PowerLightSampler sampler(lights);
  for (const auto& light : lights) EXPECT_NEAR(double(sampler.Pmf(*light)), .25, 1e-6);
}

TEST(FixedLightSampler, FollowsPowerWithAUniformShare) {
  const auto lights = Lights({1, 3});
  const PowerLightSampler sampler(lights);
  const double share = PowerLightSampler::kUniformShare;
  EXPECT_NEAR(double(sampler.Pmf(*lights[0])), (1 - share) * .25 + share * .5, 1e-6);
  const UniformLightSampler uniform(lights);
  EXPECT_NEAR(double(uniform.Pmf(*lights[0])), .5, 1e-6);
}

TEST(FixedLightSampler, NeverStarvesALightWhosePowerIsUnderestimated) {
  const auto lights = Lights({0, 5, kInfinity});
  const PowerLightSampler sampler(lights);
  for (const auto& light : lights)
    EXPECT_GE(double(sampler.Pmf(*light)), PowerLightSampler::kUniformShare / 3 - 1e-6);
}

TEST(FixedLightSampler, NeverChoosesABlackLight) {
  const auto lights = Lights({-1, 5, -1, 2, -1});
  const PowerLightSampler sampler(lights);
  for (const Real u : {Real(0), Real(.3), Real(.9), kOneMinusEpsilon}) {
    const auto choice = sampler.Sample(u);
    EXPECT_TRUE(choice.index == 1 || choice.index == 3);
    EXPECT_EQ(choice.light, lights[std::size_t(choice.index)].get());
    EXPECT_EQ(choice.probability, sampler.Pmf(*choice.light));
    EXPECT_LT(choice.remapped, 1);
  }
  EXPECT_EQ(sampler.Pmf(*lights[0]), 0);
}

TEST(FixedLightSampler, SharesTheUniformPartAmongLightsThatShine) {
  const auto lights = Lights({1, -1, 3, -1});
  const PowerLightSampler sampler(lights);
  const double share = PowerLightSampler::kUniformShare;
  EXPECT_NEAR(double(sampler.Pmf(*lights[0])), (1 - share) * .25 + share * .5, 1e-6);
  EXPECT_NEAR(double(sampler.Pmf(*lights[2])), (1 - share) * .75 + share * .5, 1e-6);
}

TEST(FixedLightSampler, OfBlackLightsOnlyIsEmpty) {
  EXPECT_TRUE(PowerLightSampler(Lights({-1, -1})).IsEmpty());
  EXPECT_TRUE(UniformLightSampler(Lights({})).IsEmpty());
}

TEST(FixedLightSampler, WithoutAnyKnownPowerIsUniform) {
  const auto lights = Lights({0, 0});
  const PowerLightSampler sampler(lights);
  EXPECT_NEAR(double(sampler.Pmf(*lights[0])), .5, 1e-6);
}

}  // namespace
}  // namespace exphoton
