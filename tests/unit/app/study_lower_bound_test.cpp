// SPDX-License-Identifier: BSD-2-Clause
// These tests compare times of photon integrators with their lower bounds, as a study states them.
#include "core/app/analysis/headline/lower_bound.h"

#include <gtest/gtest.h>

#include <stdexcept>
#include <utility>

#include "core/app/analysis/headline/headline.h"
#include "core/app/report/page_sections.h"

namespace exphoton::study {
namespace {

class StudyLowerBound : public testing::Test {
 protected:
  // exphotonmap takes 1 s to .1 and 4 s to .01, photonmap 10 and 40 s, path 20 and 80 s. All but
  // path have gather rays.
  StudyLowerBound() {
    results_.title = "room";
    analysis_.hasReference = true;
    AddLine("exphotonmap", "exphotonmap", {{1, .1}, {4, .01}});
    AddLine("photonmap", "photonmap", {{10, .1}, {40, .01}});
    AddLine("path", "path", {{20, .1}, {80, .01}});
    for (std::size_t i = 4; i < 6; ++i) results_.runs[i].rays.clear();
  }

  void AddLine(const std::string& label, const std::string& integrator,
               const std::vector<std::pair<double, double>>& costs) {
    analysis_.lines.push_back({label, {}, {}, integrator});
    for (const auto& [seconds, error] : costs) {
      const std::size_t index = results_.settings.size();
      results_.settings.push_back({label, integrator, {{"spp", std::to_string(index)}}});
      RunRow row;
      row.setting = index;
      row.rays = {{"camera", 5}, {"gather", 7}};
      results_.runs.push_back(row);
      analysis_.lines.back().settings.push_back(index);
      analysis_.settings.emplace_back();
      analysis_.settings.back().setting = index;
      analysis_.settings.back().runs = {index};
      analysis_.settings.back().cost = {{seconds, 0}, {error, 0}};
    }
  }

  using Indices = std::vector<std::size_t>;
  Indices Chosen() {
    WriteHeadline(results_, &analysis_);
    return SettingsForLowerBounds(results_, analysis_);
  }
  std::string Text() {
    WriteHeadline(results_, &analysis_);
    return analysis_.lowerBounds;
  }

  Results results_;
  Analysis analysis_;
};

TEST_F(StudyLowerBound, ComparesTheTimesOfTheHeadline) {
  EXPECT_EQ(Text(), "");
  results_.lowerBounds = {{1, .5, 8, ""}, {3, .8, 16, ""}};
  EXPECT_EQ(Text(),
            "exphotonmap takes 8 times the lower bound of 0.5 s, photonmap 50 times its own of "
            "0.8 s.");
  EXPECT_TRUE(analysis_.details.starts_with("At relMSE 0.01: exphotonmap 4 s, photonmap 40 s"))
      << analysis_.details;
  results_.clock = "wall";
  EXPECT_EQ(Text(),
            "exphotonmap takes 0.5 times the lower bound of 8 s, photonmap 2.5 times its own of "
            "16 s.");
}

TEST_F(StudyLowerBound, OfOneIntegratorNamesTheError) {
  analysis_.lines.resize(1);
  results_.lowerBounds = {{1, .5, 1, ""}};
  EXPECT_EQ(Text(), "To relMSE 0.01, exphotonmap takes 8 times the lower bound of 0.5 s.");
  analysis_.hasReference = false;
  EXPECT_EQ(Text(), "To noise 0.01, exphotonmap takes 8 times the lower bound of 0.5 s.");
}

// Without an error that two integrators reach, the details give the smallest errors.
TEST_F(StudyLowerBound, WithoutACommonErrorIsForTheSmallestErrors) {
  analysis_.lines.resize(2);
  analysis_.settings[0].cost = {{100, 0}, {.02, 0}};
  analysis_.settings[1].cost = {{200, 0}, {.01, 0}};
  for (const unsigned i : {2u, 3u}) analysis_.settings[i].cost.error.value *= 1e4;
  results_.lowerBounds = {{1, .5, 1, ""}};
  EXPECT_EQ(Text(), "exphotonmap takes 400 times the lower bound of 0.5 s.");
  EXPECT_FALSE(analysis_.target);
  EXPECT_NE(analysis_.details.find("exphotonmap 0.01 in 3.3 min"), std::string::npos)
      << analysis_.details;
}

// The headline's time is between those of two settings, and the bound is for the faster one.
TEST_F(StudyLowerBound, IsMeasuredForASettingThatIsNotSlowerThanTheHeadline) {
  EXPECT_EQ(Chosen(), (Indices{1, 3}));  // the error of the headline is .01
  for (const unsigned i : {1u, 3u, 5u}) analysis_.settings[i].cost.error.value = .007;
  EXPECT_EQ(Chosen(), (Indices{0, 2}));  // .01 is between the errors of each pair
  for (const unsigned i : {0u, 1u}) analysis_.settings[i].cost.error.value *= .01;
  EXPECT_EQ(Chosen(), (Indices{0, 2}));  // exphotonmap is more accurate from the start
}

TEST_F(StudyLowerBound, TakesTheFastestLineOfOneIntegrator) {
  for (Line& line : analysis_.lines) line.integrator = "photonmap";
  for (Setting& setting : results_.settings) setting.integrator = "photonmap";
  EXPECT_EQ(Chosen(), (Indices{1}));
}

TEST_F(StudyLowerBound, NeedsGatherRays) {
  results_.runs[1].rays = {{"camera", 5}, {"gather", 0}};
  EXPECT_EQ(Chosen(), (Indices{3}));
  analysis_.lines.erase(analysis_.lines.begin(), analysis_.lines.begin() + 2);
  EXPECT_EQ(Chosen(), Indices{});
}

TEST_F(StudyLowerBound, OfUnknownErrorsIsNotMeasured) {
  for (SettingResult& setting : analysis_.settings) setting.cost.error = {};
  EXPECT_EQ(Chosen(), Indices{});
}

TEST_F(StudyLowerBound, RendersOneSampleAndOneGatherRayWithTheSamePhotons) {
  const Setting setting = ParseSetting(
      "narrow: exphotonmap indirectphotons=7 finalgathersamples=64 time=3 "
      "sharedgather=true edgesamples=8 passes=2 gatherangle=3");
  EXPECT_EQ(LowerBoundSetting(setting).integrator, "exphotonmap");
  EXPECT_EQ(LowerBoundSetting(setting).Text(),
            "indirectphotons=7 gatherangle=3 spp=1 finalgathersamples=1 sharedgather=false "
            "edgesamples=1");
}

TEST_F(StudyLowerBound, IsExpectedForIntegratorsThatMayGather) {
  const auto expected = [](const std::vector<const char*>& plan) {
    std::vector<Setting> settings;
    for (const char* text : plan) settings.push_back(ParseSetting(text));
    std::string names;
    for (const Setting& bound : ExpectedLowerBounds(settings))
      names += bound.integrator + " " + bound.parameters.front().second + " ";
    return names;
  };
  EXPECT_EQ(expected({"path", "igi"}), "");
  EXPECT_EQ(expected({"path", "photonmap nused=9", "exphotonmap nused=5", "photonmap nused=4"}),
            "exphotonmap 5 photonmap 9 ");
  EXPECT_EQ(expected({"photonmap finalgather=false", "exphotonmap show=indirectphotons"}), "");
}

TEST_F(StudyLowerBound, StaysTheSameInJson) {
  EXPECT_TRUE(FromJson(ToJson(results_)).lowerBounds.empty());  // as in studies of older versions
  results_.lowerBounds = {{3, .5, .25, "exphoton render"}};
  const std::string json = ToJson(results_);
  const Results read = FromJson(json);
  ASSERT_EQ(read.lowerBounds.size(), 1u);
  EXPECT_EQ(read.lowerBounds[0].setting, 3u);
  EXPECT_EQ(read.lowerBounds[0].cpuSeconds, .5);
  EXPECT_EQ(read.lowerBounds[0].wallSeconds, .25);
  EXPECT_EQ(read.lowerBounds[0].command, "exphoton render");
  results_.lowerBounds[0].setting = 6;  // there are six settings
  EXPECT_THROW(FromJson(ToJson(results_)), std::runtime_error);
}

TEST_F(StudyLowerBound, IsOnThePage) {
  results_.lowerBounds = {{1, .5, 1, "exphoton render --spp 1"}};
  Analysis analysis;  // without settings, so the page needs no pictures
  analysis.details = "The details.";
  analysis.lowerBounds = "The bound.";
  const std::string opening = Opening("", results_, analysis).Markup();
  for (const char* part : {"The details. The bound. The pictures", "<b>0.5 s</b>",
                           "lower bound of exphotonmap: the time of the photon maps, one camera"})
    EXPECT_NE(opening.find(part), std::string::npos) << part << "\n" << opening;
  EXPECT_NE(MachineSection(results_, analysis)
                .Markup()
                .find("# each lower bound, here with its first seed\nexphoton render --spp 1\n"),
            std::string::npos);
  results_.lowerBounds.clear();
  EXPECT_EQ(MachineSection(results_, analysis).Markup().find("lower bound"), std::string::npos);
}

}  // namespace
}  // namespace exphoton::study
