// SPDX-License-Identifier: BSD-2-Clause
// These tests analyse a study of two settings, whose pictures have one value each. All numbers of
// the rows differ, so that no two can be exchanged.
#include "core/app/analysis/analysis.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <map>
#include <sstream>

#include "core/app/analysis/summary.h"
#include "core/imaging/files/exr.h"
#include "tests/support/process.h"

namespace exphoton::study {
namespace {

RunRow MakeRow(std::size_t setting, int seed, double scale) {
  RunRow row;
  row.key = "key" + std::to_string(seed);
  row.setting = setting;
  row.seed = std::uint64_t(seed);
  row.threads = 3;
  row.wallSeconds = 2 * scale;
  row.cpuSeconds = 5 * scale;
  row.peakMemory = 1000 * scale;
  row.samplesPerPixel = 16 * scale;
  row.isComplete = seed != 2;
  row.phases = {{"parse", .5 * scale}, {"render", 4 * scale}};
  row.phaseWall = {{"parse", .25 * scale}, {"render", 1.5 * scale}};
  row.rays = {{"camera", 70 * scale}, {"shadow", 90 * scale}};
  row.counters = {{"photons/direct stored", 100 * scale},
                  {"photons/direct paths", 50 * scale},
                  {"photons/caustic stored", 10 * scale},
                  {"photons/caustic paths", 20 * scale},
                  {"photons/memory", 4 * scale}};
  row.image = "images/" + std::to_string(setting) + "-" + std::to_string(seed) + ".exr";
  row.command = "exphoton, seed " + std::to_string(seed);
  return row;
}

Results TwoSettings() {
  Results results;
  results.program = "program";
  results.fingerprint = "fingerprint";
  results.processor = "processor";
  results.system = "system";
  results.cores = 7;
  results.title = "room";
  results.scene = "scene";
  results.sceneHash = "scene hash";
  results.command = "command";
  results.seeds = 2;
  results.targets = {.1, .01};
  results.crops = {{.1, .2, .3, .4}};
  results.settings = {{"base", "path", {{"spp", "4"}}}, {"photons", "photonmap", {}}};
  results.reference = {"a.exr", "b.exr", "other", "other hash", "path", "reference command", 64, 9};
  results.maps = {{"map.exr", "time.ms", "Cost", "ms"}};
  results.runs = {MakeRow(0, 1, 1), MakeRow(1, 1, 10), MakeRow(0, 2, 3), MakeRow(1, 2, 30)};
  return results;
}

// Rows of CSV by the names of their columns. No field of these studies has a comma of its own.
std::vector<std::map<std::string, std::string>> ReadCsv(const std::string& text) {
  std::vector<std::vector<std::string>> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) {
    EXPECT_EQ(line.back(), '\r');
    line.pop_back();
    std::istringstream fields(line + ",");
    lines.emplace_back();
    for (std::string field; std::getline(fields, field, ',');) lines.back().push_back(field);
    EXPECT_EQ(lines.back().size(), lines.front().size());
  }
  std::vector<std::map<std::string, std::string>> rows;
  for (std::size_t i = 1; i < lines.size(); ++i) {
    rows.emplace_back();
    for (std::size_t k = 0; k < lines[0].size(); ++k) rows.back()[lines[0][k]] = lines[i][k];
  }
  return rows;
}

void ExpectColumns(const std::map<std::string, std::string>& row,
                   const std::map<std::string, std::string>& expected) {
  for (const auto& [name, value] : expected) {
    const auto found = row.find(name);
    ASSERT_NE(found, row.end()) << name;
    EXPECT_EQ(found->second, value) << name;
  }
}

TEST(StudyResults, KeepEveryFieldInJson) {
  const Results a = TwoSettings();
  const Results b = FromJson(ToJson(a));
  EXPECT_EQ(b.program, "program");
  EXPECT_EQ(b.fingerprint, "fingerprint");
  EXPECT_EQ(b.processor, "processor");
  EXPECT_EQ(b.system, "system");
  EXPECT_EQ(b.cores, 7);
  EXPECT_EQ(b.title, "room");
  EXPECT_EQ(b.scene, "scene");
  EXPECT_EQ(b.sceneHash, "scene hash");
  EXPECT_EQ(b.command, "command");
  EXPECT_EQ(b.clock, "cpu");
  EXPECT_EQ(b.seeds, 2);
  EXPECT_EQ(b.targets, a.targets);
  EXPECT_EQ(b.crops, a.crops);
  EXPECT_EQ(b.settings, a.settings);
  const ReferenceRecord& r = b.reference;
  EXPECT_EQ(r.a + " " + r.b + " " + r.scene + " " + r.sceneHash + " " + r.integrator,
            "a.exr b.exr other other hash path");
  EXPECT_EQ(r.command, "reference command");
  EXPECT_EQ(r.samplesPerPixel, 64);
  EXPECT_EQ(r.seconds, 9);
  ASSERT_EQ(b.maps.size(), 1u);
  EXPECT_EQ(b.maps[0].image + b.maps[0].channel + b.maps[0].title + b.maps[0].unit,
            "map.exrtime.msCostms");
}

TEST(StudyResults, KeepEveryFieldOfARunInJson) {
  const Results a = TwoSettings();
  const Results b = FromJson(ToJson(a));
  ASSERT_EQ(b.runs.size(), 4u);
  for (std::size_t i = 0; i < 4; ++i) {
    const RunRow &row = b.runs[i], &expected = a.runs[i];
    EXPECT_EQ(row.key, expected.key);
    EXPECT_EQ(row.setting, expected.setting);
    EXPECT_EQ(row.seed, expected.seed);
    EXPECT_EQ(row.threads, 3);
    EXPECT_EQ(row.wallSeconds, expected.wallSeconds);
    EXPECT_EQ(row.cpuSeconds, expected.cpuSeconds);
    EXPECT_EQ(row.peakMemory, expected.peakMemory);
    EXPECT_EQ(row.samplesPerPixel, expected.samplesPerPixel);
    EXPECT_EQ(row.isComplete, i < 2);
    EXPECT_EQ(row.phases, expected.phases);
    EXPECT_EQ(row.phaseWall, expected.phaseWall);
    EXPECT_EQ(row.rays, expected.rays);
    EXPECT_EQ(row.counters, expected.counters);
    EXPECT_EQ(row.image, expected.image);
    EXPECT_EQ(row.command, expected.command);
  }
  // A row beside its picture does not know its study.
  const RunRow alone = RowFromJson(RowToJson(a.runs[3]));
  EXPECT_EQ(alone.setting, 0u);
  EXPECT_EQ(alone.command, a.runs[3].command);
  EXPECT_EQ(alone.phaseWall, a.runs[3].phaseWall);
  EXPECT_FALSE(alone.isComplete);
}

TEST(StudyResults, RefuseARunOfASettingThatIsNotThere) {
  Results results = TwoSettings();
  std::string text = ToJson(results);
  text.replace(text.find("\"setting\": 1"), 12, "\"setting\": 2");
  EXPECT_THROW(FromJson(text), std::runtime_error);
}

TEST(StudyResults, HaveTheirValuesUnderTheRightHeadings) {
  Results results = TwoSettings();
  results.runs[1].hasMetrics = true;
  results.runs[1].metrics = {1, 2, 3, 4, 5, 6, 7, 8};
  results.runs[1].flip = 9;
  results.runs[2].rays = {{"gather", 11}};
  const auto rows = ReadCsv(ToCsv(results));
  ASSERT_EQ(rows.size(), 4u);
  ExpectColumns(rows[1], {{"scene", "room"},
                          {"integrator", "photonmap"},
                          {"label", "photons"},
                          {"parameters", "as the scene says"},
                          {"seed", "1"},
                          {"threads", "3"},
                          {"samplesPerPixel", "160"},
                          {"complete", "yes"},
                          {"wallSeconds", "20"},
                          {"cpuSeconds", "50"},
                          {"peakMemoryBytes", "10000"},
                          {"seconds: parse", "5"},
                          {"seconds: render", "40"},
                          {"rays: camera", "700"},
                          {"rays: shadow", "900"},
                          {"rays: gather", "0"},
                          {"photons/memory", "40"},
                          {"photons/caustic paths", "200"},
                          {"MSE", "1"},
                          {"relMSE", "2"},
                          {"trimmedRelMSE", "3"},
                          {"p99", "4"},
                          {"meanError", "5"},
                          {"meanReference", "6"},
                          {"relativeMeanError", "7"},
                          {"nonFinitePixels", "8"},
                          {"FLIP", "9"},
                          {"image", "images/1-1.exr"}});
  ExpectColumns(rows[2], {{"label", "base"},
                          {"integrator", "path"},
                          {"parameters", "spp=4"},
                          {"complete", "no"},
                          {"rays: gather", "11"},
                          {"rays: camera", "0"},
                          {"MSE", ""},
                          {"FLIP", ""},
                          {"image", "images/0-2.exr"}});
}

class StudyAnalysis : public testing::Test {
 protected:
  StudyAnalysis() {
    std::filesystem::create_directory(folder_.File("images"));
    // The reference is .5, without noise.
    WritePicture("a.exr", .5f);
    WritePicture("b.exr", .5f);
    WritePicture("images/0-1.exr", .75f);
    WritePicture("images/0-2.exr", .5f);
    WritePicture("images/1-1.exr", .375f);
    WritePicture("images/1-2.exr", .625f);
  }
  void WritePicture(const std::string& name, float value) const {
    Image image(3, 2, {"R", "G", "B"});
    for (float& pixel : image.pixels) pixel = value;
    WriteExr(folder_.File(name), image, false);
  }
  Analysis AnalyseIt(Results results) const {
    MeasureRuns(folder_.Path(), &results);
    return Analyse(folder_.Path(), results);
  }

  TestFolder folder_;
};

TEST_F(StudyAnalysis, MeasuresEachRunAgainstTheReference) {
  Results results = TwoSettings();
  MeasureRuns(folder_.Path(), &results);
  for (const RunRow& row : results.runs) EXPECT_TRUE(row.hasMetrics);
  EXPECT_NEAR(results.runs[0].metrics.meanError, .25, 1e-6);
  EXPECT_NEAR(results.runs[1].metrics.meanError, -.125, 1e-6);
  EXPECT_NEAR(results.runs[1].metrics.meanReference, .5, 1e-6);
  EXPECT_NEAR(results.runs[0].metrics.relMse, .0625 / .26, 1e-6);
  EXPECT_NEAR(results.runs[2].flip, 0, 1e-6);
  EXPECT_GT(results.runs[0].flip, .01);
  results = TwoSettings();
  results.reference = {};
  MeasureRuns(folder_.Path(), &results);
  EXPECT_FALSE(results.runs[0].hasMetrics);
}

TEST_F(StudyAnalysis, AveragesTheRunsOfASetting) {
  const Analysis analysis = AnalyseIt(TwoSettings());
  ASSERT_EQ(analysis.settings.size(), 2u);
  const SettingResult &base = analysis.settings[0], &photons = analysis.settings[1];
  EXPECT_EQ(base.runs, (std::vector<std::size_t>{0, 2}));
  EXPECT_EQ(photons.runs, (std::vector<std::size_t>{1, 3}));
  EXPECT_DOUBLE_EQ(base.cpu.value, 10);
  EXPECT_DOUBLE_EQ(base.wall.value, 4);
  EXPECT_DOUBLE_EQ(base.cpu.error, 5);  // half of the difference of 5 and 15
  EXPECT_DOUBLE_EQ(base.cost.seconds.value, 10);
  EXPECT_DOUBLE_EQ(photons.samplesPerPixel, 320);
  EXPECT_DOUBLE_EQ(photons.peakMemory, 20000);
  EXPECT_DOUBLE_EQ(photons.photonsStored, 2200);
  EXPECT_DOUBLE_EQ(photons.photonPaths, 1000);
  EXPECT_NEAR(base.mse, .03125, 1e-6);
  EXPECT_NEAR(base.meanError, .125, 1e-6);
  EXPECT_NEAR(base.relativeMean, .25, 1e-6);
  EXPECT_NEAR(base.trimmed, .03125 / .26, 1e-6);
  EXPECT_NEAR(base.p99, .125 / std::sqrt(.26), 1e-6);
  EXPECT_NEAR(photons.meanError, 0, 1e-6);
  // Errors are relMSE; the noise is the variance between two pictures.
  EXPECT_NEAR(base.cost.error.value, .03125 / .26, 1e-6);
  EXPECT_NEAR(base.separation.variance.value, .03125 / .26, 1e-6);
  EXPECT_NEAR(base.Efficiency(), .26 / (.03125 * 10), 1e-4);
  EXPECT_NEAR(photons.cost.error.value, .015625 / .26, 1e-6);
  EXPECT_NEAR(photons.separation.bias2.value, -.015625 / .26, 1e-6);
}

TEST_F(StudyAnalysis, SharesTheSecondsOfItsClockAmongThePhases) {
  Results results = TwoSettings();
  EXPECT_EQ(AnalyseIt(results).settings[0].phases,
            (NamedValues{{"parse", 1}, {"render", 8}, {"other", 1}}));
  results.clock = "wall";
  const Analysis analysis = AnalyseIt(results);
  EXPECT_EQ(analysis.settings[0].phases,
            (NamedValues{{"parse", .5}, {"render", 3}, {"other", .5}}));
  EXPECT_DOUBLE_EQ(analysis.settings[0].cost.seconds.value, 4);
  results.runs[0].phaseWall = {{"render", 100}};
  EXPECT_EQ(AnalyseIt(results).settings[0].phases.back().second, 0);
}

TEST_F(StudyAnalysis, WithoutAReferenceHasTheNoiseOnly) {
  Results results = TwoSettings();
  results.reference = {};
  const Analysis analysis = AnalyseIt(results);
  EXPECT_FALSE(analysis.hasReference);
  const SettingResult& base = analysis.settings[0];
  // The mean of .75 and .5 takes the reference's place.
  EXPECT_NEAR(base.cost.error.value, .03125 / (.625 * .625 + .01), 1e-6);
  EXPECT_FALSE(base.separation.bias2.IsKnown());
}

TEST_F(StudyAnalysis, CountsPixelsThatAreNotFiniteAndLeavesOutSettingsWithoutRuns) {
  Image image(3, 2, {"R", "G", "B"});
  for (float& pixel : image.pixels) pixel = .5f;
  image.At(1, 1, 2) = std::nanf("");
  image.At(2, 0, 0) = INFINITY;
  WriteExr(folder_.File("images/1-1.exr"), image, false);
  Results results = TwoSettings();
  results.settings.insert(results.settings.begin(), Setting{"none", "path", {}});
  for (RunRow& row : results.runs) ++row.setting;
  const Analysis analysis = AnalyseIt(results);
  ASSERT_EQ(analysis.settings.size(), 2u);
  EXPECT_EQ(analysis.settings[0].setting, 1u);
  EXPECT_EQ(analysis.settings[1].nonFinite, 2);
  EXPECT_EQ(analysis.settings[0].nonFinite, 0);
  ASSERT_EQ(analysis.lines.size(), 2u);
  EXPECT_EQ(analysis.lines[1].label, "photons");
  EXPECT_EQ(analysis.lines[1].settings, (std::vector<std::size_t>{1}));
}

TEST_F(StudyAnalysis, JoinsSettingsOfALabelToALine) {
  Results results = TwoSettings();
  results.settings[1].label = "base";
  const Analysis analysis = AnalyseIt(results);
  ASSERT_EQ(analysis.lines.size(), 1u);
  EXPECT_EQ(analysis.lines[0].settings, (std::vector<std::size_t>{0, 1}));
  EXPECT_EQ(analysis.lines[0].integrator, "path");
  EXPECT_DOUBLE_EQ(analysis.Points({1})[0].seconds.value, 100);
}

TEST_F(StudyAnalysis, AFrontHasNoPictureWithHalfTheErrorOfABlackOne) {
  Results results = TwoSettings();
  // The reference is .5, so a black picture has an error of .25 / .26.
  const Analysis analysis = AnalyseIt(results);
  EXPECT_NEAR(analysis.usefulError, .5 * .25 / .26, 1e-6);
  EXPECT_EQ(analysis.Front(), (std::vector<std::size_t>{0, 1}));
  WritePicture("images/0-1.exr", 0);
  WritePicture("images/0-2.exr", 0);
  EXPECT_EQ(AnalyseIt(results).Front(), (std::vector<std::size_t>{1}));
  results.reference = {};
  EXPECT_TRUE(std::isinf(AnalyseIt(results).usefulError));
}

TEST_F(StudyAnalysis, HasItsMeansUnderTheRightHeadingsOfTheSummary) {
  const Results results = TwoSettings();
  const auto rows = ReadCsv(SummaryCsv(results, AnalyseIt(results)));
  ASSERT_EQ(rows.size(), 2u);
  ExpectColumns(rows[0], {{"label", "base"},           {"integrator", "path"},
                          {"parameters", "spp=4"},     {"seeds", "2"},
                          {"cpuSeconds", "10"},        {"cpuSeconds +-", "5"},
                          {"wallSeconds", "4"},        {"wallSeconds +-", "2"},
                          {"error", "0.12019231"},     {"relMSE", "0.12019231"},
                          {"noise", "0.12019231"},     {"bias2", "0"},
                          {"relativeEfficiency", "1"}, {"MSE", "0.03125"},
                          {"meanError", "0.125"},      {"relativeMeanError", "0.25"},
                          {"nonFinitePixels", "0"},    {"samplesPerPixel", "32"},
                          {"photonPaths", "100"},      {"photonsStored", "220"},
                          {"peakMemoryBytes", "2000"}, {"onFront", "yes"}});
  // Half of the error for ten times the seconds.
  ExpectColumns(rows[1], {{"relativeEfficiency", "0.2"}, {"onFront", "yes"}, {"seeds", "2"}});
}

}  // namespace
}  // namespace exphoton::study
