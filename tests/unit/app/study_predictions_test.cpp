// SPDX-License-Identifier: BSD-2-Clause
// These tests put the quotes of a study beside its measurements.
#include "core/app/analysis/predictions.h"

#include <gtest/gtest.h>

#include <limits>

#include "core/app/analysis/analysis.h"
#include "core/app/report/chart/cost_chart.h"
#include "core/app/report/page_sections.h"

namespace exphoton::study {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

class StudyPredictions : public testing::Test {
 protected:
  // path is measured with 1 and 4 s; its quote is 2 s for an error of .1 and 8 s for .025.
  StudyPredictions() {
    results_.settings = {{"path", "path", {{"spp", "4"}}},
                         {"path", "path", {{"spp", "16"}}},
                         {"fine", "path", {{"spp", "4"}}}};
    results_.predictions = {{"path", "", {{.1, 2, 1, 4}, {.025, 8, 2, 16}}},
                            {"photonmap", "it failed", {}}};
    analysis_.hasReference = true;
    analysis_.settings = {Measure(0, 1, .1), Measure(1, 4, .05), Measure(2, 9, .04)};
    analysis_.lines = {{"path", {0, 1}, {}, "path"}, {"fine", {2}, {}, "path"}};
  }

  static SettingResult Measure(std::size_t setting, double seconds, double error) {
    SettingResult result;
    result.setting = setting;
    result.cpu = {seconds, .1};
    result.cost = {result.cpu, {error, .001}};
    return result;
  }

  Results results_;
  Analysis analysis_;
};

TEST_F(StudyPredictions, InterpolateBetweenTheirPoints) {
  const Prediction& path = results_.predictions[0];
  const auto middle = path.At(.05);
  ASSERT_TRUE(middle);
  EXPECT_NEAR(middle->seconds, 4, 1e-9);
  EXPECT_NEAR(middle->least, std::sqrt(2.), 1e-9);
  EXPECT_NEAR(middle->most, 8, 1e-9);
  EXPECT_NEAR(path.At(.1)->seconds, 2, 1e-9);
  EXPECT_NEAR(path.At(.025)->seconds, 8, 1e-9);
  EXPECT_FALSE(path.At(.11));
  EXPECT_FALSE(path.At(.024));
}

TEST_F(StudyPredictions, AreComparedWithTheFrontOfTheIntegratorsOwnLine) {
  const auto checks = CheckPredictions(results_, analysis_);
  ASSERT_EQ(checks.size(), 2u);
  EXPECT_EQ(checks[0].setting, 0u);
  EXPECT_NEAR(checks[0].Ratio(), .5, 1e-9);
  EXPECT_TRUE(checks[0].IsInside());
  EXPECT_NEAR(checks[1].Ratio(), 1, 1e-9);
  analysis_.settings[1].cpu = {8.5, .1};
  EXPECT_FALSE(CheckPredictions(results_, analysis_)[1].IsInside());
  analysis_.settings[1].cpu = {1.3, .1};
  EXPECT_FALSE(CheckPredictions(results_, analysis_)[1].IsInside());
}

TEST_F(StudyPredictions, AreNotComparedWithErrorsThatLeaveOutTheBias) {
  analysis_.hasReference = false;
  EXPECT_TRUE(CheckPredictions(results_, analysis_).empty());
}

TEST_F(StudyPredictions, StayTheSameInJson) {
  results_.predictions[0].points[1].most = kInfinity;
  const Results read = FromJson(ToJson(results_));
  ASSERT_EQ(read.predictions.size(), 2u);
  EXPECT_EQ(read.predictions[0].integrator, "path");
  EXPECT_EQ(read.predictions[1].failure, "it failed");
  const Prediction::Point& point = read.predictions[0].points.at(1);
  EXPECT_EQ(point.error, .025);
  EXPECT_EQ(point.seconds, 8);
  EXPECT_EQ(point.least, 2);
  EXPECT_EQ(point.most, kInfinity);
  EXPECT_EQ(read.predictions[0].points[0].most, 4);
}

TEST_F(StudyPredictions, AreDashedLinesOfTheChart) {
  analysis_.settings.push_back(Measure(0, 20, .01));
  analysis_.lines[0].settings.push_back(3);
  const std::string chart = CostChart(results_, analysis_, kWideChart).Markup();
  EXPECT_NE(chart.find("class=\"expected "), std::string::npos);
  EXPECT_NE(chart.find("dashed: quotes"), std::string::npos);
  results_.clock = "wall";  // quotes are CPU times
  EXPECT_EQ(CostChart(results_, analysis_, kWideChart).Markup().find("expected "),
            std::string::npos);
}

TEST_F(StudyPredictions, HaveASectionOfThePage) {
  results_.predictions[0].points[1].most = kInfinity;
  const std::string page = PredictionSection(results_, analysis_).Markup();
  for (const char* text :
       {"2 of 2 times lie inside the interval, 1 of 2 within a factor of 1.5",
        "<td>1 s to 4 s</td>", "no known end", "<td>0.5</td>", "photonmap has no quote: it failed"})
    EXPECT_NE(page.find(text), std::string::npos) << text << "\n" << page;
  results_.predictions.erase(results_.predictions.begin());
  EXPECT_NE(PredictionSection(results_, analysis_).Markup().find("no setting can be compared"),
            std::string::npos);
  results_.predictions.clear();
  EXPECT_TRUE(PredictionSection(results_, analysis_).IsEmpty());
}

}  // namespace
}  // namespace exphoton::study
