// SPDX-License-Identifier: BSD-2-Clause
// These tests check Pareto fronts, times to an error and costs of parameters, on points made by
// hand.
#include "core/app/analysis/curves.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/app/analysis/analysis.h"
#include "core/app/report/headline.h"
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
  EXPECT_DOUBLE_EQ(costs[0].secondsPerDoubling, 4);
  EXPECT_NEAR(costs[0].errorFactor, std::sqrt(.125), 1e-12);
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
  EXPECT_DOUBLE_EQ(costs[0].secondsPerDoubling, 0);
  EXPECT_DOUBLE_EQ(costs[0].errorFactor, 1);
  EXPECT_EQ(costs[1].parameter, "rays");
  EXPECT_DOUBLE_EQ(costs[1].secondsPerDoubling, 1.5);
  EXPECT_NEAR(costs[1].errorFactor, .5, 1e-12);
  EXPECT_EQ(costs[1].pairs, 2);
}

Analysis TwoLines(std::vector<CostPoint> a, std::vector<CostPoint> b) {
  Analysis analysis;
  analysis.hasReference = true;
  analysis.lines = {{"fast", {}, {}}, {"slow", {}, {}}};
  for (std::size_t line = 0; line < 2; ++line) {
    for (const CostPoint& point : line == 0 ? a : b) {
      SettingResult setting;
      setting.cost = point;
      analysis.lines[line].settings.push_back(analysis.settings.size());
      analysis.settings.push_back(setting);
    }
  }
  return analysis;
}

Results Titled() {
  Results results;
  results.title = "room";
  return results;
}

TEST(StudyHeadline, NamesTimesAndTheRatioAtEqualError) {
  Analysis analysis = TwoLines({At(1, .1), At(10, .01)}, {At(7, .1), At(70, .01)});
  WriteHeadline(Titled(), &analysis);
  EXPECT_EQ(analysis.headline, "On room, fast reaches relMSE 0.01 in 10 s, slow in 70 s (7 ± 0×).");
}

TEST(StudyHeadline, GivesErrorsOfRatiosADigitThatIsNotZero) {
  Analysis analysis = TwoLines({At(1, .1), At(10, .01, .05)}, {At(7, .1), At(19, .01, .1)});
  WriteHeadline(Titled(), &analysis);
  EXPECT_EQ(analysis.headline,
            "On room, fast reaches relMSE 0.01 in 10 s, slow in 19 s (1.9 ± 0.01×).");
  analysis = TwoLines({At(1, .1)}, {At(20, .1, .4)});
  WriteHeadline(Titled(), &analysis);
  EXPECT_NE(analysis.headline.find("“slow” is 0.05 ± 0.001 times as efficient"), std::string::npos)
      << analysis.headline;
}

TEST(StudyHeadline, SaysWhereALineNeverGotThere) {
  Analysis analysis = TwoLines({At(1, .1), At(10, .01)}, {At(7, .1), At(70, .01)});
  analysis.lines.push_back({"black", {analysis.settings.size()}, {}});
  SettingResult black;
  black.cost = At(.5, .9);
  analysis.settings.push_back(black);
  WriteHeadline(Titled(), &analysis);
  EXPECT_NE(analysis.headline.find("black never gets there (at best 0.9, in 0.5 s)"),
            std::string::npos)
      << analysis.headline;
}

TEST(StudyHeadline, RefusesRatiosThatTheReferencesNoiseDoesNotAllow) {
  Analysis analysis = TwoLines({At(1, .1), At(10, .01)}, {At(7, .1), At(70, .01)});
  analysis.reference.variance = {.004, .0001};  // 10 % of .04: .05 is comparable, .03 is not
  WriteHeadline(Titled(), &analysis);
  ASSERT_TRUE(analysis.target);
  EXPECT_DOUBLE_EQ(*analysis.target, .05);
  analysis.reference.variance = {.02, .001};
  WriteHeadline(Titled(), &analysis);
  EXPECT_FALSE(analysis.target);
  EXPECT_NE(analysis.headline.find("too noisy"), std::string::npos) << analysis.headline;
  EXPECT_EQ(ShortfallText(analysis.reference, .01),
            "the reference's noise is 200 % of this; one rendered 20 times as long would do");
}

TEST(StudyHeadline, OfSingleSettingsNamesTheMostEfficient) {
  Analysis analysis = TwoLines({At(1, .1)}, {At(2, .01)});
  analysis.reference.variance = {.0001, .00001};
  WriteHeadline(Titled(), &analysis);
  EXPECT_EQ(analysis.headline,
            "On room, “slow” is 5 ± 0 times as efficient (1 / (error × seconds)) as fast.");
  analysis.reference.variance = {.002, .0001};  // 20 % of the second error
  WriteHeadline(Titled(), &analysis);
  EXPECT_EQ(analysis.headline.find("efficient"), std::string::npos) << analysis.headline;
}

TEST(StudyHeadline, WithoutAReferenceSpeaksOfNoise) {
  Analysis analysis = TwoLines({At(1, .1), At(10, .01)}, {At(7, .1), At(70, .01)});
  analysis.hasReference = false;
  WriteHeadline(Titled(), &analysis);
  EXPECT_EQ(analysis.headline,
            "On room, fast reaches a noise (without bias) of 0.01 in 10 s, slow in 70 s (7 ± 0×).");
}

TEST(StudyHeadline, WithoutACommonErrorNamesTheLeastOnes) {
  Analysis analysis = TwoLines({At(1, .1), At(10, .06)}, {At(7, 4), At(70, 2)});
  WriteHeadline(Titled(), &analysis);
  EXPECT_EQ(
      analysis.headline,
      "On room, no error was reached by two lines. Least errors: fast 0.06 in 10 s, slow 2 in "
      "70 s.");
}

TEST(StudyHeadline, SaysWhereALineWasMoreAccurateFromTheStart) {
  Analysis analysis = TwoLines({At(1, .1), At(10, .01)}, {At(7, .1), At(70, .01)});
  analysis.lines.push_back({"fine", {analysis.settings.size()}, {}});
  SettingResult fine;
  fine.cost = At(90, .005);
  analysis.settings.push_back(fine);
  WriteHeadline(Titled(), &analysis);
  EXPECT_NE(analysis.headline.find(", fine in at most 90 s."), std::string::npos)
      << analysis.headline;
}

TEST(StudyHeadline, NamesAtMostThreeEfficiencies) {
  Analysis analysis = TwoLines({At(1, .1)}, {At(2, .1)});
  for (const double seconds : {4., .5, 8.}) {
    analysis.lines.push_back({"in " + SecondsText(seconds), {analysis.settings.size()}, {}});
    SettingResult setting;
    setting.cost = At(seconds, .1);
    analysis.settings.push_back(setting);
  }
  WriteHeadline(Titled(), &analysis);
  EXPECT_EQ(analysis.headline,
            "On room, “in 0.5 s” is 2 ± 0 times as efficient (1 / (error × seconds)) as fast; next "
            "are “slow” with 0.5 ± 0, “in 4 s” with 0.25 ± 0.");
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

TEST(StudyMarkup, ShortNumbersKeepTheirDigits) {
  EXPECT_EQ(ShortNumber(.0123), "0.012");
  EXPECT_EQ(ShortNumber(7), "7");
  EXPECT_EQ(ShortNumber(1234), "1234");
  EXPECT_EQ(ShortNumber(.1), "0.1");
  EXPECT_EQ(ShortNumber(0), "0");
  EXPECT_EQ(SecondsText(9.83), "9.8 s");
  EXPECT_EQ(SecondsText(640), "10.7 min");
  EXPECT_EQ(SecondsText(99), "99 s");
  EXPECT_EQ(SecondsText(99.9), "1.7 min");
  EXPECT_EQ(SecondsText(5950), "1.7 h");
  EXPECT_EQ(ShortNumber(-.5), "−0.5");
  EXPECT_EQ(ShortNumber(kUnknown), "–");
  EXPECT_EQ(ShortNumber(.00005), "5.0e-05");
  EXPECT_EQ(ShortNumber(.0001), "0.0001");
  EXPECT_EQ(ShortNumber(1e5), "1.0e+05");
  EXPECT_EQ(ShortNumber(.01264, 3), "0.0126");
}

}  // namespace
}  // namespace exphoton::study
