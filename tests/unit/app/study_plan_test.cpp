// SPDX-License-Identifier: BSD-2-Clause
// These tests check the meaning of a study's words, and that a study's data is the same after
// writing and reading.
#include "core/app/analysis/plan.h"

#include <gtest/gtest.h>

#include <set>
#include <stdexcept>

#include "core/app/analysis/results.h"

namespace exphoton::study {
namespace {

class Oracle final : public ParameterLookup {
 public:
  bool Has(const std::string& integrator, const std::string& parameter) const override {
    return (integrator == "photonmap" && parameter == "indirectphotons") || parameter == "maxdepth";
  }
};

std::vector<std::string> Texts(const std::vector<Setting>& settings) {
  std::vector<std::string> texts;
  for (const Setting& s : settings) texts.push_back(s.label + ": " + s.Text());
  return texts;
}

TEST(StudyPlan, ReadsSettingsWithAndWithoutLabels) {
  const Setting plain = ParseSetting("path maxdepth=100 spp=16");
  EXPECT_EQ(plain.label, "path");
  EXPECT_EQ(plain.Text(), "maxdepth=100 spp=16");
  const Setting labelled = ParseSetting("+ Simpson kernel: photonmap kernel=simpson");
  EXPECT_EQ(labelled.label, "+ Simpson kernel");
  EXPECT_EQ(labelled.integrator, "photonmap");
  for (const char* wrong : {"", "kernel=simpson", "path maxdepth", "path =3", "label: "})
    EXPECT_THROW(ParseSetting(wrong), std::invalid_argument) << wrong;
}

TEST(StudyPlan, GivesEveryHalfOfEveryRoundOfAReferenceASeedOfItsOwn) {
  std::set<std::uint64_t> seeds;
  for (int round = 0; round < 100; ++round)
    for (int half = 0; half < 2; ++half) seeds.insert(ReferenceSeed(round, half));
  EXPECT_EQ(seeds.size(), 200u);
  EXPECT_GT(*seeds.begin(), 1000000u);  // the runs have the seeds 1, 2, ...
}

TEST(StudyPlan, ReadsKnobsAndBudgets) {
  const VariedParameter varied = ParseVariedParameter("path:spp=1,4, 16");
  EXPECT_EQ(varied.integrator, "path");
  EXPECT_EQ(varied.parameter, "spp");
  EXPECT_EQ(varied.values, (std::vector<std::string>{"1", "4", "16"}));
  EXPECT_THROW(ParseVariedParameter("spp"), std::invalid_argument);
  EXPECT_THROW(ParseVariedParameter("spp=,"), std::invalid_argument);
  EXPECT_EQ(ParseBudgets("1,4,16s"), (std::vector<double>{1, 4, 16}));
  EXPECT_EQ(ParseBudgets("1,2m"), (std::vector<double>{60, 120}));
  EXPECT_EQ(ParseBudgets("1.5h"), std::vector<double>{5400});
  for (const char* wrong : {"", "0", "-1", "4x", "s", "1,0"}) {
    try {
      ParseBudgets(wrong);
      ADD_FAILURE() << wrong;
    } catch (const std::invalid_argument& error) {
      EXPECT_TRUE(std::string(error.what()).starts_with("--budgets ")) << error.what();
    }
  }
}

TEST(StudyPlan, MultipliesKnobsWhereTheyApply) {
  StudyPlan plan;
  plan.bases = {ParseSetting("photonmap"), ParseSetting("path")};
  plan.varied = {ParseVariedParameter("spp=1,4"), ParseVariedParameter("indirectphotons=10,20"),
                 ParseVariedParameter("path:spp=64")};
  EXPECT_EQ(Texts(ExpandPlan(plan, Oracle())),
            (std::vector<std::string>{"photonmap: spp=1 indirectphotons=10",
                                      "photonmap: spp=1 indirectphotons=20",
                                      "photonmap: spp=4 indirectphotons=10",
                                      "photonmap: spp=4 indirectphotons=20", "path: spp=64"}));
}

TEST(StudyPlan, AKnobOfOneIntegratorWinsOverThatOfAllInAnyOrder) {
  const std::vector<std::string> expected{"path: spp=64", "photonmap: spp=1"};
  for (const bool isSpecialFirst : {false, true}) {
    StudyPlan plan;
    plan.bases = {ParseSetting("path"), ParseSetting("photonmap")};
    plan.varied = {ParseVariedParameter("spp=1"), ParseVariedParameter("path:spp=64")};
    if (isSpecialFirst) std::swap(plan.varied[0], plan.varied[1]);
    EXPECT_EQ(Texts(ExpandPlan(plan, Oracle())), expected) << isSpecialFirst;
  }
}

TEST(StudyPlan, AWordOfASettingWinsOverKnobs) {
  StudyPlan plan;
  plan.bases = {ParseSetting("path spp=2")};
  plan.varied = {ParseVariedParameter("spp=1,4"), ParseVariedParameter("maxdepth=5,100")};
  plan.bases.push_back(ParseSetting("path"));
  const std::vector<std::string> texts = Texts(ExpandPlan(plan, Oracle()));
  EXPECT_EQ(texts.size(), 6u);
  EXPECT_EQ(texts[1], "path: spp=2 maxdepth=100");
}

TEST(StudyPlan, BudgetsAreTimesAndAKnobThatAppliesToNothingIsAnError) {
  StudyPlan plan;
  plan.bases = {ParseSetting("path")};
  plan.budgets = {1, 4};
  EXPECT_EQ(Texts(ExpandPlan(plan, Oracle())),
            (std::vector<std::string>{"path: time=1", "path: time=4"}));
  plan.varied = {ParseVariedParameter("indirectphotons=10")};
  EXPECT_THROW(ExpandPlan(plan, Oracle()), std::invalid_argument);
}

Results Sample() {
  Results results;
  results.program = "exphoton test";
  results.title = "a, \"quoted\" room";
  results.targets = {.1, .01};
  results.crops = {{0, .5, .25, .75}};
  results.settings = {ParseSetting("path maxdepth=100 spp=4")};
  results.reference.a = "reference/a.exr";
  results.maps = {{"images/x.exr", "time.ms", "Cost", "ms"}};
  RunRow row;
  row.key = "abc";
  row.seed = 3;
  row.cpuSeconds = 1.25;
  row.phases = {{"render", 1.0}};
  row.counters = {{"photons/direct stored", 100},
                  {"photons/direct paths", 50},
                  {"photons/indirect stored", 10},
                  {"photons/indirect paths", 40}};
  row.image = "images/x.exr";
  results.runs = {row};
  return results;
}

TEST(StudyResults, AreTheSameAfterWritingAndReading) {
  const Results results = Sample();
  const Results again = FromJson(ToJson(results));
  EXPECT_EQ(ToJson(again), ToJson(results));
  EXPECT_EQ(again.settings, results.settings);
  EXPECT_EQ(again.runs[0].PhotonsStored(), 110);
  EXPECT_EQ(again.runs[0].PhotonPaths(), 50);
  EXPECT_EQ(RowFromJson(RowToJson(results.runs[0])).cpuSeconds, 1.25);
}

TEST(StudyResults, MayNameFilesOfAnyBytes) {
  RunRow row;
  row.command = "exphoton \xe9t\xc3\xa9.pbrt";
  EXPECT_EQ(RowFromJson(RowToJson(row)).command, "exphoton \xef\xbf\xbdt\xc3\xa9.pbrt");
}

TEST(StudyResults, HaveOneCsvRowARunAndQuoteWhatNeedsIt) {
  const std::string csv = ToCsv(Sample());
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 2);
  EXPECT_NE(csv.find("\"a, \"\"quoted\"\" room\",path,path,maxdepth=100 spp=4,3,"),
            std::string::npos)
      << csv;
}

TEST(StudyResults, RefuseWhatIsNoData) {
  for (const char* wrong : {"", "{", "[]", "{\"format\":99}", "{\"format\":1}"})
    EXPECT_THROW(FromJson(wrong), std::runtime_error) << wrong;
}

TEST(StudyResults, TakeWhatARenderSaysAndIgnoreTheRest) {
  RunRow row;
  AddRunStatistics(R"({"threads":2,"samplesPerPixel":4,"complete":true,"news":[1,{}],
    "phases":[{"name":"render","seconds":1.5,"cpuSeconds":3}],"rays":{"camera":12},
    "counters":{"photons/memory":1000,"odd":null}})",
                   &row);
  EXPECT_EQ(row.threads, 2);
  EXPECT_EQ(row.phases, (NamedValues{{"render", 3}}));
  EXPECT_EQ(row.phaseWall, (NamedValues{{"render", 1.5}}));
  EXPECT_EQ(row.rays, (NamedValues{{"camera", 12}}));
  EXPECT_EQ(row.Counter("photons/memory"), 1000);
  EXPECT_THROW(AddRunStatistics("", &row), std::runtime_error);
}

TEST(StudyPlan, FilesHaveTheNamesOfTheirSettings) {
  EXPECT_EQ(RunName({"fast", "path", {{"maxdepth", "100"}, {"spp", "16"}}}, 3),
            "path_maxdepth=100_spp=16_seed=3");
  EXPECT_EQ(RunName({"x", "path", {}}, 1), "path_seed=1");
  EXPECT_EQ(RunName({"x", "path", {{"Sampler.jitter", "-1.5e+2"}}}, 1),
            "path_Sampler.jitter=-1.5e+2_seed=1");
}

TEST(StudyPlan, FilesOfDifferentSettingsHaveDifferentSafeNames) {
  const std::vector<Setting> settings{{"x", "path", {{"a", "b/c"}}},
                                      {"x", "path", {{"a", "b c"}}},
                                      {"x", "path", {{"a", "b-c"}}},
                                      {"x", "path", {{"a", "1_b=2"}}},
                                      {"x", "path", {{"a", "1"}, {"b", "2"}}},
                                      {"x", "path", {{"a", std::string(300, 'y')}}},
                                      {"x", "path", {{"a", std::string(301, 'y')}}}};
  std::set<std::string> names;
  for (const Setting& setting : settings) {
    const std::string name = RunName(setting, 1);
    EXPECT_EQ(name.find_first_of("/ "), std::string::npos) << name;
    EXPECT_LT(name.size(), 200u);
    names.insert(name);
  }
  EXPECT_EQ(names.size(), settings.size());
}

}  // namespace
}  // namespace exphoton::study
