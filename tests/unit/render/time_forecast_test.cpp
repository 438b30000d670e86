// SPDX-License-Identifier: BSD-2-Clause
// These tests check the estimates of the time left of renders in several passes.
#include <gtest/gtest.h>

#include <cmath>

#include "core/render/passes/progress/pass_progress.h"

namespace exphoton {
namespace {

constexpr std::size_t kPixels = 200 * 150;

StoppingRule TargetRule(double target) {
  StoppingRule rule;
  rule.targetError = target;
  return rule;
}

PassPlan PlanOf(const StoppingRule& rule) {
  return PassPlan({rule.targetError, rule.timeLimit, rule.maxSamples, rule.passSamples,
                   rule.accuracy ? rule.accuracy->firstSamples : 0,
                   rule.accuracy ? rule.accuracy->photonSamples : 0});
}

// Returns the estimate in the first pass.
std::optional<TimeForecast::Estimate> InFirstPass(const StoppingRule& rule,
                                                  const TimeForecast::Scene& scene,
                                                  const TimeForecast::Pass& pass) {
  TimeForecast forecast(rule, scene);
  const PassPlan plan = PlanOf(rule);
  forecast.Begin(plan, plan.Next({}), {});
  return forecast.Left(pass);
}

// A tenth of the pixels of the pass took 1 s, after 2 s of photons.
const TimeForecast::Pass kTenthRendered{{.28, .1, 1, true}, 3, 0, 30};

TEST(TimeForecast, FollowsTheSamplesOfAnAccuracy) {
  StoppingRule rule;
  rule.accuracy = {.error = .05, .firstSamples = 8};
  const auto left = InFirstPass(rule, {kPixels, true, 1}, kTenthRendered);
  ASSERT_TRUE(left);
  // The rest of this pass, a second set of photons and another pass.
  EXPECT_NEAR(left->left, 9 + 2 + 10, 1e-9);
  EXPECT_FALSE(left->isRough);
}

TEST(TimeForecast, TakesTheSamplesThatPilotsExpectBeforeTheFirstLook) {
  StoppingRule rule;
  rule.accuracy = {.error = .05, .firstSamples = 8, .expectedSamples = 24};
  const auto left = InFirstPass(rule, {kPixels, true, 1}, kTenthRendered);
  ASSERT_TRUE(left);
  EXPECT_NEAR(left->left, 9 + 2 + 20, 1e-9);
}

TEST(TimeForecast, KnowsThePriceOfPhotonsForAnAccuracy) {
  StoppingRule rule;
  rule.accuracy = {.error = .05, .firstSamples = 8, .photonSamples = 2};
  // Half of the photons took 1 s, so all maps take about 2.9 s.
  const TimeForecast::Pass pass{{.07, .5, 1, false}, 1, 0, 0};
  const auto left = InFirstPass(rule, {kPixels, true, 2}, pass);
  ASSERT_TRUE(left);
  EXPECT_TRUE(left->isRough);
  const double photons = .2 / .07, sample = photons / 2;
  EXPECT_NEAR(left->left, photons - 1 + 16 * sample + photons, .1);
}

TEST(TimeForecast, IsRoughBeforeTheNoiseOfATargetIsKnown) {
  const StoppingRule rule = TargetRule(.002);
  const TimeForecast::Scene shared{kPixels, true, 0}, alone{kPixels, false, 0};
  const auto left = InFirstPass(rule, shared, kTenthRendered);
  ASSERT_TRUE(left);
  EXPECT_TRUE(left->isRough);
  EXPECT_GT(left->left, 9 + 10);
  EXPECT_FALSE(InFirstPass(rule, alone, kTenthRendered)) << "its noise may be anything";
  // More rays in a sample mean less noise.
  TimeForecast::Pass costly = kTenthRendered;
  costly.rays = 300;
  EXPECT_LT(InFirstPass(rule, shared, costly)->left, left->left);
}

TEST(TimeForecast, FollowsTheForecastOfTheNoise) {
  const StoppingRule rule = TargetRule(.002);
  PassPlan plan = PlanOf(rule);
  PassPlan::State state;
  for (int pass = 0; pass < 2; ++pass) {
    plan.Take(plan.Next(state));
    ++state.samples;
    state.sample = 10;
  }
  state.enough = 16;
  TimeForecast forecast(rule, {kPixels, false, 0});
  const PassPlan::Step step = plan.Next(state);
  forecast.Begin(plan, step, state);
  const auto left = forecast.Left({{.6, .5, 5. * double(step.size), true}, 10, 20, 30});
  ASSERT_TRUE(left);
  EXPECT_FALSE(left->isRough);
  EXPECT_NEAR(left->left, 10 * (16 - 2 - .5 * double(step.size)), 1e-6);
}

TEST(TimeForecast, EndsAtATimeLimit) {
  StoppingRule rule = TargetRule(1e-6);
  rule.timeLimit = 30;
  // Two more samples would not fit.
  const auto left = InFirstPass(rule, {kPixels, true, 0}, kTenthRendered);
  ASSERT_TRUE(left);
  EXPECT_NEAR(left->left, 9 + 2 + 10, 1e-9);
  // The whole time is left as long as nothing else is known.
  const auto atFirst = InFirstPass(rule, {kPixels, false, 0}, {{.001, .01, 1, false}, 1, 0, 0});
  ASSERT_TRUE(atFirst);
  EXPECT_EQ(atFirst->left, 29);
}

TEST(TimeForecast, CountsThePhotonsOfEachProgressivePass) {
  StoppingRule rule;
  rule.passSamples = 1;
  rule.maxSamples = 5;
  const auto left = InFirstPass(rule, {kPixels, true, 0}, kTenthRendered);
  ASSERT_TRUE(left);
  EXPECT_NEAR(left->left, 9 + 4 * (10 + 2), 1e-9);
}

TEST(TimeForecast, SaysNothingBeforeTheFirstPhotons) {
  const StoppingRule rule = TargetRule(.002);
  const TimeForecast::Scene scene{kPixels, true, 0};
  EXPECT_FALSE(InFirstPass(rule, scene, {{.001, .01, .1, false}, .1, 0, 0}));
  const auto left = InFirstPass(rule, scene, {{.07, .5, 1, false}, 1, 0, 0});
  ASSERT_TRUE(left);
  EXPECT_TRUE(left->isRough);
  EXPECT_NEAR(left->left, 1 * .93 / .07, 1e-9);
}

}  // namespace
}  // namespace exphoton
