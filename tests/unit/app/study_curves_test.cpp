// SPDX-License-Identifier: BSD-2-Clause
// These tests check Pareto fronts, times to an error and costs of parameters, on points made by
// hand.
#include "core/app/analysis/curves.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/app/report/markup.h"

namespace exphoton::study {
namespace {

using Kind = TimeToError::Kind;

CostPoint At(double seconds, double error, double secondsError = 0, double errorError = 0) {
  return {{seconds, secondsError}, {error, errorError}};
}

TEST(StudyCurves, AFrontHoldsWhatNothingBeats) {
  const std::vector<CostPoint> points{At(4, .1), At(1, .5),  At(2, .6),
                                      At(3, .2), At(4, .09), At(9, .09)};
  EXPECT_EQ(ParetoFront(points), (std::vector<std::size_t>{1, 3, 4}));
}

TEST(StudyCurves, AFrontLeavesOutWhatIsNotKnown) {
  EXPECT_EQ(ParetoFront({At(1, kUnknown), At(2, -.1), At(3, .2)}), (std::vector<std::size_t>{2}));
  EXPECT_TRUE(ParetoFront({}).empty());
}

TEST(StudyCurves, TimeToAnErrorIsInterpolatedInLogLog) {
  // The points lie on error = 1 / seconds, where the interpolation is exact.
  const TimeToError t = FindTimeToError({At(1, 1), At(100, .01)}, .1);
  EXPECT_EQ(t.kind, Kind::Reached);
  EXPECT_NEAR(t.seconds.value, 10, 1e-9);
  EXPECT_DOUBLE_EQ(FindTimeToError({At(1, 1), At(100, .01)}, .01).seconds.value, 100);
}

TEST(StudyCurves, TimeToAnErrorIsNeverExtrapolated) {
  const std::vector<CostPoint> points{At(1, 1), At(100, .01)};
  const TimeToError never = FindTimeToError(points, .009);
  EXPECT_EQ(never.kind, Kind::Never);
  EXPECT_EQ(never.best.error.value, .01);
  const TimeToError atMost = FindTimeToError(points, 2);
  EXPECT_EQ(atMost.kind, Kind::AtMost);
  EXPECT_EQ(atMost.seconds.value, 1);
  EXPECT_EQ(FindTimeToError({}, 1).kind, Kind::Never);
}

TEST(StudyCurves, TheErrorOfATimeComesFromThoseOfItsPoints) {
  // The time lies halfway between points on error = 1/seconds, each with 10 % uncertainty in time
  // and in error. By hand, the relative uncertainty is sqrt(2 (0.5^2 (0.1^2 + 0.1^2))) = 0.1.
  const TimeToError t = FindTimeToError({At(1, 1, .1, .1), At(100, .01, 10, .001)}, .1);
  EXPECT_NEAR(t.seconds.error, .1 * t.seconds.value, 1e-9);
}

// A tenth of the error costs a hundredfold time, and the target is a third of the way, so that no
// two terms are equal.
TEST(StudyCurves, TheErrorOfATimeDependsOnTheSlope) {
  const double target = std::pow(.1, 1. / 3);
  const auto relative = [&](const CostPoint& a, const CostPoint& b) {
    const TimeToError t = FindTimeToError({a, b}, target);
    EXPECT_NEAR(t.seconds.value, std::pow(100, 1. / 3), 1e-9);
    return t.seconds.error / t.seconds.value;
  };
  EXPECT_NEAR(relative(At(1, 1, .03), At(100, .1)), .02, 1e-9);
  EXPECT_NEAR(relative(At(1, 1), At(100, .1, 3)), .01, 1e-9);
  EXPECT_NEAR(relative(At(1, 1, 0, .03), At(100, .1)), .04, 1e-9);
  EXPECT_NEAR(relative(At(1, 1), At(100, .1, 0, .003)), .02, 1e-9);
  EXPECT_NEAR(relative(At(1, 1, kUnknown, .03), At(100, .1, kUnknown, kUnknown)), .04, 1e-9);
}

TEST(StudyCurves, TimeToAnErrorUsesThePartOfTheFrontThatHoldsIt) {
  // In any order, and with a point that others beat.
  const std::vector<CostPoint> points{At(100, .01), At(3, 1.5), At(1, 1), At(10, .5)};
  EXPECT_NEAR(FindTimeToError(points, .5).seconds.value, 10, 1e-9);
  EXPECT_NEAR(FindTimeToError(points, std::sqrt(.5)).seconds.value, std::sqrt(10), 1e-9);
  EXPECT_NEAR(FindTimeToError(points, std::sqrt(.005)).seconds.value, std::sqrt(1000), 1e-9);
  EXPECT_EQ(FindTimeToError(points, 1).kind, Kind::Reached);
  EXPECT_EQ(FindTimeToError(points, 1).seconds.value, 1);
}

TEST(StudyCurves, AKnobsPriceLeavesOutWhatIsNotComparable) {
  const auto setting = [](const char* label, const char* rays, const char* kernel) {
    return Setting{label, "x", {{"rays", rays}, {"kernel", kernel}}};
  };
  // 16 to 4 is compared in the order of the values. "z" has no second value with the same kernel.
  const std::vector<Setting> settings{setting("y", "16", "cone"), setting("y", "4", "cone"),
                                      setting("y", "8", "cone"),  setting("z", "4", "cone"),
                                      setting("z", "8", "disk"),  setting("y", "0", "cone")};
  const std::vector<CostPoint> points{At(10, .1), At(2, .8),        At(1, kUnknown),
                                      At(1, 1),   At(100, .000001), At(1, 1)};
  const std::vector<DoublingEffect> costs = FindDoublingEffects(settings, points);
  ASSERT_EQ(costs.size(), 1u);
  EXPECT_EQ(costs[0].label, "y");
  EXPECT_EQ(costs[0].pairs, 1);
  EXPECT_DOUBLE_EQ(costs[0].secondsPerDoubling.value, 4);
  EXPECT_NEAR(costs[0].errorFactor.value, std::sqrt(.125), 1e-12);
}

TEST(StudyCurves, ARatioAddsRelativeErrorsInSquares) {
  const Measured ratio = Ratio({8, .4}, {2, .1});
  EXPECT_DOUBLE_EQ(ratio.value, 4);
  EXPECT_NEAR(ratio.error, 4 * std::hypot(.05, .05), 1e-12);
}

TEST(StudyCurves, AKnobsPriceIsThatOfOneDoubling) {
  const auto setting = [](const char* rays, const char* photons) {
    return Setting{"x", "x", {{"rays", rays}, {"photons", photons}, {"kernel", "simpson"}}};
  };
  // The points have seconds = rays / 8 and error = 8 / rays, with any number of photons. A factor
  // of four is two doublings.
  const std::vector<Setting> settings{setting("8", "100"), setting("32", "100"),
                                      setting("8", "200"), setting("32", "200")};
  const std::vector<CostPoint> points{At(1, 1), At(4, .25), At(1, 1), At(4, .25)};
  const std::vector<DoublingEffect> costs = FindDoublingEffects(settings, points);
  ASSERT_EQ(costs.size(), 2u);
  EXPECT_EQ(costs[0].parameter, "photons");
  EXPECT_DOUBLE_EQ(costs[0].secondsPerDoubling.value, 0);
  EXPECT_DOUBLE_EQ(costs[0].errorFactor.value, 1);
  EXPECT_EQ(costs[1].parameter, "rays");
  EXPECT_DOUBLE_EQ(costs[1].secondsPerDoubling.value, 1.5);
  EXPECT_NEAR(costs[1].errorFactor.value, .5, 1e-12);
  EXPECT_EQ(costs[1].pairs, 2);
}

TEST(StudyCurves, TheErrorOfADoublingCountsSharedSettingsOnce) {
  const auto setting = [](const char* spp) { return Setting{"x", "x", {{"spp", spp}}}; };
  // Two pairs share the middle setting, so its errors cancel: only the ends are left.
  const std::vector<Setting> settings{setting("1"), setting("2"), setting("4")};
  const std::vector<CostPoint> points{At(1, 1, .3, .1), At(2, .5, 100, 10), At(4, .25, .4, .05)};
  const std::vector<DoublingEffect> costs = FindDoublingEffects(settings, points);
  ASSERT_EQ(costs.size(), 1u);
  EXPECT_NEAR(costs[0].secondsPerDoubling.error, std::hypot(.3, .4) / 2, 1e-12);
  EXPECT_NEAR(costs[0].errorFactor.error, .5 * std::hypot(.1, .05 / .25) / 2, 1e-12);
}

TEST(StudyMarkup, EncodesBase64AsRfc4648DoesInItsExamples) {
  EXPECT_EQ(Base64(""), "");
  EXPECT_EQ(Base64("f"), "Zg==");
  EXPECT_EQ(Base64("fo"), "Zm8=");
  EXPECT_EQ(Base64("foo"), "Zm9v");
  EXPECT_EQ(Base64("foobar"), "Zm9vYmFy");
}

TEST(StudyMarkup, EscapesWhatMarkupWouldTake) {
  EXPECT_EQ(Escape("<a href=\"x\">&").Markup(), "&lt;a href=&quot;x&quot;&gt;&amp;");
}

TEST(StudyMarkup, ALogScaleHasTicksAtOneTwoAndFive) {
  const LogScale scale(1, 10, 0, 100);
  std::vector<double> values;
  for (const LogScale::Tick& tick : scale.Ticks()) values.push_back(tick.value);
  EXPECT_EQ(values, (std::vector<double>{1, 2, 5, 10}));
  EXPECT_NEAR(scale(std::sqrt(10)), 50, 1e-9);
}

}  // namespace
}  // namespace exphoton::study
