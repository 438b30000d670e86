// SPDX-License-Identifier: BSD-2-Clause
// These tests check the sentence of a study: its integrators, its error and its ratios.
#include "core/app/analysis/headline/headline.h"

#include <gtest/gtest.h>

#include "core/app/analysis/headline/target.h"

namespace exphoton::study {
namespace {

CostPoint CostAt(double seconds, double error, double secondsError = 0, double errorError = 0) {
  return {{seconds, secondsError}, {error, errorError}};
}

void AddLine(const std::string& label, const std::string& integrator,
             const std::vector<CostPoint>& points, Analysis* analysis) {
  analysis->lines.push_back({label, {}, {}, integrator});
  for (const CostPoint& point : points) {
    analysis->lines.back().settings.push_back(analysis->settings.size());
    analysis->settings.emplace_back();
    analysis->settings.back().cost = point;
  }
}

Analysis TwoLines(const std::vector<CostPoint>& a, const std::vector<CostPoint>& b) {
  Analysis analysis;
  analysis.hasReference = true;
  AddLine("fast", "fast", a, &analysis);
  AddLine("slow", "slow", b, &analysis);
  return analysis;
}

Analysis SevenTimes() {
  return TwoLines({CostAt(1, .1), CostAt(10, .01)}, {CostAt(7, .1), CostAt(70, .01)});
}

void Write(Analysis* analysis) {
  Results results;
  results.title = "room";
  WriteHeadline(results, analysis);
}

TEST(StudyHeadline, GivesTheShareOfTimeToTheSameError) {
  Analysis analysis = SevenTimes();
  Write(&analysis);
  EXPECT_EQ(analysis.headline, "On room, to the same error fast needs 1/7 of slow's time.");
  EXPECT_EQ(analysis.details, "At relMSE 0.01: fast 10 s, slow 70 s (7 ± 0 times).");
}

TEST(StudyHeadline, NamesTheErrorThatMostIntegratorsReach) {
  Analysis analysis = SevenTimes();
  AddLine("path", "path", {CostAt(4, .3), CostAt(430, .03)}, &analysis);
  Write(&analysis);
  // Two lines reach .01, but three reach .03.
  ASSERT_TRUE(analysis.target);
  EXPECT_DOUBLE_EQ(*analysis.target, .03);
  EXPECT_EQ(analysis.headline,
            "On room, to the same error fast needs 1/7 of slow's time and 1/130 of path's.");
}

TEST(StudyHeadline, NamesAnErrorThatShowsWhoIsFastest) {
  // Three have a time at .1, but the cheapest picture of "fast" is better than that, so it may need
  // less time than "rough".
  Analysis analysis = TwoLines({CostAt(1, .05), CostAt(10, .01)}, {CostAt(7, .1), CostAt(70, .01)});
  AddLine("rough", "rough", {CostAt(.1, .5), CostAt(.9, .1)}, &analysis);
  Write(&analysis);
  ASSERT_TRUE(analysis.target);
  EXPECT_DOUBLE_EQ(*analysis.target, .01);
  EXPECT_EQ(analysis.headline,
            "On room, to the same error fast needs 1/7 of slow's time; rough does not reach it.");
}

TEST(StudyHeadline, CountsManySettingsOfOneIntegratorAsOne) {
  Analysis analysis = SevenTimes();
  for (const char* label : {"narrow", "wide"})
    AddLine(label, "fast", {CostAt(1, .1), CostAt(300, .0001)}, &analysis);
  AddLine("path", "path", {CostAt(4, .3), CostAt(430, .05)}, &analysis);
  Write(&analysis);
  ASSERT_TRUE(analysis.target);
  EXPECT_DOUBLE_EQ(*analysis.target, .05);
  ASSERT_EQ(analysis.contenders.size(), 3u);
  EXPECT_EQ(analysis.contenders[0].variants, (std::vector<std::size_t>{2, 3}));
  EXPECT_TRUE(analysis.headline.starts_with("On room, to the same error fast needs 1/7 of"))
      << analysis.headline;
  EXPECT_NE(analysis.details.find(" Variants: narrow "), std::string::npos) << analysis.details;
}

TEST(StudyHeadline, ComparesTheLinesOfASingleIntegrator) {
  Analysis analysis = SevenTimes();
  for (Line& line : analysis.lines) line.integrator = "photonmap";
  Write(&analysis);
  EXPECT_EQ(analysis.headline, "On room, to the same error fast needs 1/7 of slow's time.");
}

TEST(StudyHeadline, TakesAllLinesOfAnIntegratorIfNoneHasItsName) {
  Analysis analysis = SevenTimes();
  analysis.lines[0].integrator = analysis.lines[1].integrator = "photonmap";
  AddLine("path", "path", {CostAt(10, .1), CostAt(100, .01)}, &analysis);
  Write(&analysis);
  ASSERT_EQ(analysis.contenders.size(), 2u);
  EXPECT_EQ(analysis.contenders[0].settings.size(), 4u);
  EXPECT_EQ(analysis.headline, "On room, to the same error photonmap needs 1/10 of path's time.");
}

TEST(StudyHeadline, GivesPerCentForSimilarTimes) {
  Analysis analysis =
      TwoLines({CostAt(1, .1), CostAt(10, .01, .05)}, {CostAt(7, .1), CostAt(19, .01, .1)});
  Write(&analysis);
  EXPECT_EQ(analysis.headline, "On room, to the same error fast needs 53 % of slow's time.");
  EXPECT_EQ(analysis.details, "At relMSE 0.01: fast 10 s, slow 19 s (1.90 ± 0.01 times).");
}

TEST(StudyHeadline, SaysWhoDoesNotReachTheError) {
  Analysis analysis = SevenTimes();
  AddLine("black", "black", {CostAt(.5, .9)}, &analysis);
  Write(&analysis);
  EXPECT_EQ(analysis.headline,
            "On room, to the same error fast needs 1/7 of slow's time; black does not reach it.");
  EXPECT_NE(analysis.details.find("black never (at best 0.9, in 0.5 s)"), std::string::npos)
      << analysis.details;
  AddLine("grey", "grey", {CostAt(.5, .9)}, &analysis);
  Write(&analysis);
  EXPECT_NE(analysis.headline.find("; black and grey do not reach it."), std::string::npos)
      << analysis.headline;
}

TEST(StudyHeadline, NamesNoErrorOfABlackPicture) {
  // All three reach an error of 1, but a black picture has nearly this error.
  Analysis analysis = SevenTimes();
  AddLine("black", "black", {CostAt(.5, 2), CostAt(9, .9)}, &analysis);
  analysis.usefulError = .45;
  Write(&analysis);
  ASSERT_TRUE(analysis.target);
  EXPECT_DOUBLE_EQ(*analysis.target, .01);
}

TEST(StudyHeadline, NamesAtMostThreeOthers) {
  Analysis analysis = SevenTimes();
  for (const char* name : {"c", "d", "e"})
    AddLine(name, name, {CostAt(20, .1), CostAt(200, .01)}, &analysis);
  Write(&analysis);
  EXPECT_EQ(analysis.headline,
            "On room, to the same error fast needs 1/7 of slow's time, 1/20 of c's and 1/20 of "
            "d's.");
}

// One seed without a reference measures no error.
TEST(StudyHeadline, ComparesNoErrorsThatAreUnknown) {
  const std::vector<CostPoint> unknown{CostAt(1, kUnknown), CostAt(10, kUnknown)};
  Analysis analysis = TwoLines(unknown, unknown);
  analysis.hasReference = false;
  Write(&analysis);
  EXPECT_EQ(analysis.headline, "On room, too few errors are known to compare them.");
  EXPECT_EQ(analysis.details, "");
}

TEST(StudyHeadline, RefusesRatiosThatTheReferencesNoiseDoesNotAllow) {
  Analysis analysis = SevenTimes();
  analysis.reference.variance = {.004, .0001};  // 10 % of .04: .05 is comparable, .03 is not
  Write(&analysis);
  ASSERT_TRUE(analysis.target);
  EXPECT_DOUBLE_EQ(*analysis.target, .05);
  analysis.reference.variance = {.02, .001};
  Write(&analysis);
  EXPECT_FALSE(analysis.target);
  EXPECT_EQ(analysis.headline, "On room, the reference is too noisy to compare errors.");
  EXPECT_EQ(ShortfallText(analysis.reference, .01),
            "the reference's noise is 200 % of this; one rendered 20 times as long would do");
}

TEST(StudyHeadline, WithoutAReferenceSpeaksOfNoise) {
  Analysis analysis = SevenTimes();
  analysis.hasReference = false;
  Write(&analysis);
  EXPECT_EQ(analysis.headline, "On room, to the same noise fast needs 1/7 of slow's time.");
  EXPECT_EQ(analysis.details, "At noise 0.01: fast 10 s, slow 70 s (7 ± 0 times).");
}

TEST(StudyHeadline, BoundsTheRatioIfTheCheapestPictureIsMoreAccurate) {
  // The slow line's smallest error is the only one that both have a time for.
  Analysis analysis = TwoLines({CostAt(1, .1), CostAt(10, .06)}, {CostAt(7, 4), CostAt(70, 2)});
  Write(&analysis);
  EXPECT_EQ(analysis.headline,
            "On room, to the same error fast needs at most 1/70 of slow's time.");
}

TEST(StudyHeadline, ComparesErrorsIfNoTimeCanBeCompared) {
  Analysis analysis = TwoLines({CostAt(10, .1), CostAt(100, .06)}, {CostAt(.7, 4), CostAt(7, 2)});
  Write(&analysis);
  EXPECT_FALSE(analysis.target);
  EXPECT_EQ(analysis.headline, "On room, fast has 1/33 of the error of slow at best.");
  EXPECT_EQ(analysis.details, "Least errors: fast 0.06 in 1.7 min, slow 2 in 7 s.");
}

TEST(StudyHeadline, NamesAnErrorOfThePriceListThatTwoReach) {
  Results results;
  results.title = "room";
  results.targets = {.075};
  Analysis analysis =
      TwoLines({CostAt(1, .09), CostAt(10, .071)}, {CostAt(7, .09), CostAt(70, .072)});
  WriteHeadline(results, &analysis);
  ASSERT_TRUE(analysis.target);
  EXPECT_DOUBLE_EQ(*analysis.target, .075);
}

TEST(StudyHeadline, OfOneLineGivesThePriceOfAccuracy) {
  Analysis analysis;
  analysis.hasReference = true;
  AddLine("path", "path", {CostAt(1, .1), CostAt(10, .01)}, &analysis);
  Write(&analysis);
  EXPECT_EQ(analysis.headline,
            "On room, path reaches relMSE 0.01 in 10 s, 10 times the time of 0.1.");
}

TEST(StudyHeadline, SaysWhereALineWasMoreAccurateFromTheStart) {
  Analysis analysis = SevenTimes();
  AddLine("fine", "fine", {CostAt(90, .005)}, &analysis);
  Write(&analysis);
  EXPECT_NE(analysis.details.find(", fine at most 90 s."), std::string::npos) << analysis.details;
  EXPECT_EQ(analysis.headline, "On room, to the same error fast needs 1/7 of slow's time.");
}

TEST(StudyHeadline, OfSingleSettingsNamesTheMostEfficient) {
  Analysis analysis = TwoLines({CostAt(1, .1)}, {CostAt(2, .01)});
  analysis.reference.variance = {.0001, .00001};
  Write(&analysis);
  EXPECT_EQ(analysis.headline,
            "On room, “slow” is 5 ± 0 times as efficient (1 / (error × seconds)) as fast.");
  analysis = TwoLines({CostAt(1, .1)}, {CostAt(20, .1, .4)});
  Write(&analysis);
  EXPECT_NE(analysis.headline.find("“slow” is 0.050 ± 0.001 times as efficient"), std::string::npos)
      << analysis.headline;
  analysis = TwoLines({CostAt(1, .1)}, {CostAt(2, .01)});
  analysis.reference.variance = {.002, .0001};  // 20 % of the second error
  Write(&analysis);
  EXPECT_EQ(analysis.headline.find("efficient"), std::string::npos) << analysis.headline;
}

TEST(StudyHeadline, NamesAtMostThreeEfficiencies) {
  Analysis analysis = TwoLines({CostAt(1, .1)}, {CostAt(2, .1)});
  for (const char* seconds : {"4", ".5", "8"})
    AddLine(std::string("in ") + seconds, seconds, {CostAt(std::stod(seconds), .1)}, &analysis);
  Write(&analysis);
  EXPECT_EQ(analysis.headline,
            "On room, “in .5” is 2 ± 0 times as efficient (1 / (error × seconds)) as fast; next "
            "are “slow” with 0.5 ± 0, “in 4” with 0.25 ± 0.");
}

TEST(StudyHeadline, RoundErrorsFall) {
  const std::vector<double> errors = RoundErrors();
  EXPECT_DOUBLE_EQ(errors[0], 1);
  EXPECT_DOUBLE_EQ(errors[5], .05);
  for (std::size_t i = 1; i < errors.size(); ++i) EXPECT_LT(errors[i], errors[i - 1]);
}

}  // namespace
}  // namespace exphoton::study
