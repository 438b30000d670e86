// SPDX-License-Identifier: BSD-2-Clause
// These tests read the sections of a study's page as a reader does: the text of each table row.
#include "core/app/report/page_sections.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <regex>

#include "core/app/report/chart/cost_chart.h"
#include "core/app/report/gallery.h"
#include "core/imaging/files/exr.h"
#include "tests/support/process.h"

namespace exphoton::study {
namespace {

// Returns the text between the tags. Cells and rows are separated by " | ", other tags by a blank.
std::string TextOf(const Html& html) {
  const std::string& markup = html.Markup();
  std::string text;
  for (std::size_t i = 0; i < markup.size(); ++i) {
    if (markup[i] != '<') {
      text += markup[i] == '\n' ? ' ' : markup[i];
      continue;
    }
    const std::size_t end = markup.find('>', i);
    const std::string tag = markup.substr(i + 1, end - i - 1);
    const bool isCell = tag.starts_with("td") || tag.starts_with("th ") || tag == "th";
    text += isCell ? " | " : " ";
    i = end;
  }
  std::string squeezed;
  for (const char c : text)
    if (c != ' ' || (!squeezed.empty() && squeezed.back() != ' ')) squeezed += c;
  return squeezed;
}

long CountOf(const Html& html, const std::string& part) {
  long count = 0;
  for (std::size_t at = 0; (at = html.Markup().find(part, at)) != std::string::npos; ++at) ++count;
  return count;
}

void ExpectText(const Html& html, const std::string& part) {
  EXPECT_NE(TextOf(html).find(part), std::string::npos) << part << "\nnot in\n" << TextOf(html);
}

SettingResult MakeSetting(std::size_t setting, double seconds, double error) {
  SettingResult s;
  s.setting = setting;
  s.runs = {setting};
  s.flip = .15;
  s.cost = {{seconds, seconds / 10}, {error, error / 10}};
  s.cpu = {seconds, seconds / 10};
  s.wall = {seconds / 2, seconds / 20};
  s.separation.relMse = {error + .001, .002};
  s.separation.variance = {.75 * error, .003};
  s.separation.bias2 = {.25 * error, .004};
  return s;
}

class ReportSections : public testing::Test {
 protected:
  ReportSections() {
    results_.title = "room";
    results_.scene = "a/room.pbrt";
    results_.sceneHash = "1";
    results_.seeds = 3;
    results_.targets = {.5, .05, .0005};
    results_.settings = {{"path", "path", {{"spp", "4"}}},
                         {"path", "path", {{"spp", "16"}}},
                         {"photons", "photonmap", {{"spp", "8"}}}};
    results_.reference = {"a.exr", "b.exr", "b/other.pbrt", "2", "path", "make it", 50000, 640};
    for (std::size_t i = 0; i < 3; ++i) {
      RunRow row;
      row.setting = i;
      row.threads = 5;
      row.image = "picture.exr";
      row.command = "command " + std::to_string(i);
      results_.runs.push_back(row);
      results_.runs.push_back(row);
      results_.runs.back().command = "another seed";
    }
    analysis_.hasReference = true;
    analysis_.headline = "The <headline>.";
    analysis_.reference.variance = {.0004, .0001};
    analysis_.settings = {MakeSetting(0, 1, .4), MakeSetting(1, 4, .04), MakeSetting(2, 2, .3)};
    analysis_.lines = {{"path", {0, 1}, {}, {}}, {"photons", {2}, {}, {}}};
    analysis_.contenders = {{"path", 0, {0, 1}, {}, {}}, {"photons", 1, {2}, {}, {}}};
    Image picture(12, 9, {"R", "G", "B"});
    for (float& value : picture.pixels) value = .5f;
    analysis_.reference.mean = picture;
    WriteExr(folder_.File("picture.exr"), picture, false);
  }

  Html OpeningOf(const Analysis& analysis) const {
    return Opening(folder_.Path(), results_, analysis);
  }

  TestFolder folder_;
  Results results_;
  Analysis analysis_;
};

TEST_F(ReportSections, TheOpeningNamesTheReferenceAndTheRenders) {
  Html html = OpeningOf(analysis_);
  ExpectText(html, "The &lt;headline&gt;.");
  ExpectText(html, "path, 50 k samples a pixel the reference, in 10.7 min");
  ExpectText(html, "4×10⁻⁴ relMSE of the reference's own noise");
  ExpectText(html, "6 renders 3 settings with 3 independent seeds each");
  ExpectText(html, "0 pixels are NaN or infinite, in all pictures");
  ExpectText(html, "(r² + 0.01); times are CPU seconds of the whole process");
  ExpectText(html, "variant of the scene, b/other.pbrt , which");
  ExpectText(html, "other runs render a/room.pbrt");
  analysis_.settings[0].nonFinite = 2;
  analysis_.settings[2].nonFinite = 3;
  analysis_.reference.variance = {};
  results_.reference.integrator = "";
  results_.reference.samplesPerPixel = results_.reference.seconds = 0;
  results_.reference.scene = "";
  results_.clock = "wall";
  html = OpeningOf(analysis_);
  ExpectText(html, "5 pixels are NaN or infinite and were left out");
  ExpectText(html, "a given picture the reference unknown noise of the reference");
  ExpectText(html, "times are seconds of the whole process");
  EXPECT_EQ(TextOf(html).find("variant of the scene"), std::string::npos);
  analysis_.hasReference = false;
  html = OpeningOf(analysis_);
  ExpectText(html, "No reference only the noise between seeds is known");
  ExpectText(html, "Noise is measured between seeds");
}

TEST_F(ReportSections, ASceneWithTheSameContentIsNoVariant) {
  results_.reference.sceneHash = "1";
  EXPECT_EQ(TextOf(OpeningOf(analysis_)).find("variant"), std::string::npos);
}

TEST_F(ReportSections, TheOpeningShowsOnePictureOfEachIntegrator) {
  const Html html = OpeningOf(analysis_);
  EXPECT_EQ(CountOf(html, "<figure class=\"poster"), 3);  // two and the reference
  ExpectText(html, "path 1 s · relMSE 0.4 · FLIP 0.15");
  ExpectText(html, "photons 2 s · relMSE 0.3");
}

TEST_F(ReportSections, OfManyIntegratorsTheOpeningShowsThree) {
  for (std::size_t i = 3; i < 6; ++i) {
    results_.settings.push_back({std::string(1, char('a' + i)), "other", {}});
    analysis_.settings.push_back(MakeSetting(i, 1 << i, .1));
    analysis_.settings.back().runs = {0};
    analysis_.lines.push_back({results_.settings.back().label, {i}, {}, {}});
    analysis_.contenders.push_back({results_.settings.back().label, i - 1, {i}, {}, {}});
  }
  // All but the last reach the error, in the order of their lines.
  for (std::size_t i = 0; i < 4; ++i)
    analysis_.contenders[i].toTarget = {TimeToError::Kind::Reached, {1. + double(i), .1}, {}};
  const Html html = OpeningOf(analysis_);
  EXPECT_EQ(CountOf(html, "<figure class=\"poster"), 4);
  for (const char* name : {"path", "photons", "e"})
    ExpectText(html, std::string(name) + " " + (name[1] ? "" : "16 s"));
  EXPECT_EQ(TextOf(html).find(" d 8 s"), std::string::npos);
}

TEST_F(ReportSections, TheFrontIsNumberedByTime) {
  const Html html = FrontSection(results_, analysis_);
  ExpectText(html, "| line | spp | CPU seconds | error, 10⁻³");
  ExpectText(html, "| 1 | path | 4 | 1.0 ± 0.1 | 400 ± 40");
  ExpectText(html, "| 2 | photons | 8 | 2.0 ± 0.2 | 300 ± 30");
  ExpectText(html, "| 3 | path | 16 | 4.0 ± 0.4 | 40 ± 4");
}

TEST_F(ReportSections, TheFrontBeginsWithAUsefulPicture) {
  analysis_.usefulError = .35;
  const Html html = FrontSection(results_, analysis_);
  ExpectText(html, "| 1 | photons | 8 |");
  ExpectText(html, "| 2 | path | 16 |");
}

TEST_F(ReportSections, ParametersThatAreTheSameEverywhereHaveNoColumn) {
  for (Setting& setting : results_.settings) setting.parameters.emplace_back("maxdepth", "7");
  EXPECT_EQ(TextOf(FrontSection(results_, analysis_)).find("maxdepth"), std::string::npos);
  results_.settings[2].parameters.pop_back();
  ExpectText(FrontSection(results_, analysis_), "| spp | maxdepth | CPU");
  ExpectText(FrontSection(results_, analysis_), "| 2 | photons | 8 | – |");
}

TEST_F(ReportSections, AnUnknownNoiseIsTheWholeErrorOfItsBar) {
  EXPECT_EQ(CountOf(BarSection(results_, analysis_), "noise: 0.3<"), 1);  // .75 of .4
  analysis_.settings[0].separation.variance = {};
  EXPECT_EQ(CountOf(BarSection(results_, analysis_), "noise: 0.4<"), 1);
}

TEST_F(ReportSections, TheChartNamesLinesOnceAndSaysTheSlopes) {
  const Html wide = CostChart(results_, analysis_, kWideChart);
  EXPECT_EQ(CountOf(wide, ">photons</text>"), 1);
  EXPECT_EQ(wide.Markup().find("class=\"keys"), std::string::npos);
  ExpectText(wide, "relMSE, noise alone: slope −1");
  ExpectText(wide, "√relMSE, slope −1/2");
  ExpectText(wide, "photons, spp=8: 2 s, 0.3");  // the title of a mark
  const Html narrow = CostChart(results_, analysis_, kNarrowChart);
  ExpectText(narrow, "relMSE; noise alone: slope −1");
  EXPECT_EQ(TextOf(narrow).find("√"), std::string::npos);
}

// Only one of the two drawings is shown, and so are its keys.
TEST_F(ReportSections, KeysOfLinesWithoutPlaceBelongToOneDrawing) {
  for (int i = 0; i < 30; ++i)
    analysis_.lines.push_back({"a line with a long name " + std::to_string(i), {0}, {}, {}});
  const std::string wide = CostChart(results_, analysis_, kWideChart).Markup();
  const std::string narrow = CostChart(results_, analysis_, kNarrowChart).Markup();
  EXPECT_NE(wide.find("class=\"keys wide\""), std::string::npos);
  EXPECT_NE(narrow.find("class=\"keys narrow\""), std::string::npos);
}

TEST_F(ReportSections, TheChartJoinsSettingsThatDifferInSamplesOnly) {
  // Three settings of one line in two groups: two points, and one alone.
  results_.settings[2] = {"path", "path", {{"maxdepth", "3"}, {"spp", "8"}}};
  analysis_.lines = {{"path", {0, 1, 2}, {}, {}}};
  const std::string chart = CostChart(results_, analysis_, kWideChart).Markup();
  const std::regex joined("<polyline points=\"([^\"]*)\" class=\"samples c0\"");
  std::vector<long> corners;
  for (std::sregex_iterator it(chart.begin(), chart.end(), joined), end; it != end; ++it) {
    const std::string points = (*it)[1].str();
    corners.push_back(std::count(points.begin(), points.end(), ','));
  }
  EXPECT_EQ(corners, (std::vector<long>{2, 1}));
  // The envelope has a corner between each two of its three points.
  const std::regex step("<polyline points=\"([^\"]*)\" class=\"envelope c0\"");
  std::smatch found;
  ASSERT_TRUE(std::regex_search(chart, found, step));
  const std::string points = found[1].str();
  EXPECT_EQ(std::count(points.begin(), points.end(), ','), 5);
}

TEST_F(ReportSections, BarsShowTimeAndErrorOfTheFronts) {
  for (SettingResult& s : analysis_.settings)
    s.phases = {{"render", .75 * s.cost.seconds.value},
                {"new", .125 * s.cost.seconds.value},
                {"other", .125 * s.cost.seconds.value}};
  const Html html = BarSection(results_, analysis_);
  ExpectText(html, "write new other noise (variance");
  ExpectText(html, "| 4.0 ± 0.4 |");
  // The efficiency of the second setting is ten times for a fourth of the seconds.
  ExpectText(html, "| 30 ± 3 | 10 ± 4 | 2.5×");
  ExpectText(html, "| 300 ± 3 | 100 ± 4 | 1×");
  ExpectText(html, "render: 3 s");
  ExpectText(html, "new: 0.5 s");
  ExpectText(html, "noise: 0.03");
  ExpectText(html, "bias²: 0.1");
  // Bars are logarithmic from 0.5 s, half of the shortest time, to 4 s: three doublings. The
  // colours divide a bar linearly.
  EXPECT_NE(html.Markup().find("\"75%\""), std::string::npos);  // render of 4 s
  EXPECT_NE(html.Markup().find("\"25%\""), std::string::npos);  // render of 1 s: 3/4 of 1/3
  EXPECT_NE(html.Markup().find("\"50%\""), std::string::npos);  // render of 2 s: 3/4 of 2/3
  analysis_.usefulError = .35;
  EXPECT_EQ(TextOf(BarSection(results_, analysis_)).find("| path | 4 |"), std::string::npos);
}

TEST_F(ReportSections, PricesNameTheCheapestSettingOfEachLine) {
  analysis_.settings[0].peakMemory = 3 << 20;
  analysis_.settings[1].peakMemory = 5 << 20;
  analysis_.settings[2].peakMemory = 7 << 20;
  analysis_.settings[2].photonsStored = 12000;
  const Html html = PriceSection(results_, analysis_);
  ExpectText(html, "error 0.5 | path | 1 s | 1× | 4 | 3 | – | photons | 2 s | 2× | 8 | 7 | 12 k");
  ExpectText(html, "error 0.05 | path | 4 s | 1× | 16 | 5 | – | none of the settings of photons");
  ExpectText(html,
             "error 5×10⁻⁴ | refused: the reference's noise is 80 % of this; one rendered 8 times");
  EXPECT_NE(html.Markup().find("<span class=\"best\">1 s</span>"), std::string::npos);
  EXPECT_EQ(html.Markup().find("<span class=\"best\">2 s</span>"), std::string::npos);
}

TEST_F(ReportSections, DoublingsHaveStandardErrors) {
  // Two doublings cost 3 seconds and divide the error by 10.
  ExpectText(DoublingSection(results_, analysis_), "path | spp | +1.5 ± 0.2 s | −68 ± 2 % | 1");
}

TEST_F(ReportSections, DoublingsAreOrderedAsTheLines) {
  results_.settings.push_back({"photons", "photonmap", {{"spp", "4"}}});
  results_.settings.push_back({"absent", "igi", {}});
  analysis_.settings.push_back(MakeSetting(3, 3, .2));
  analysis_.lines = {{"photons", {2, 3}, {}, {}}, {"path", {0, 1}, {}, {}}};
  const std::string text = TextOf(DoublingSection(results_, analysis_));
  // Half of the samples cost a second more and have two thirds of the error.
  const std::size_t photons = text.find("photons | spp | −1.0 ± 0.4 s | +50 ± 20 % | 1");
  ASSERT_NE(photons, std::string::npos) << text;
  EXPECT_GT(text.find("path | spp | +1.5 ± 0.2 s"), photons);
}

TEST_F(ReportSections, EverySettingHasEveryValue) {
  SettingResult& s = analysis_.settings[1];
  s.trimmed = .11;
  s.mse = .12;
  s.relativeMean = .013;
  s.p99 = .14;
  s.flip = .15;
  s.nonFinite = 16;
  s.samplesPerPixel = 170;
  s.photonPaths = 18000;
  s.photonsStored = 2.5e6;
  s.peakMemory = 20. * (1 << 20);
  analysis_.settings[0].relativeMean = -.5;
  const Html html = SettingSection(results_, analysis_);
  ExpectText(html,
             "path | 16 | 4.0 ± 0.4 | 2.0 ± 0.2 | 41 ± 2 | 110 | 30 ± 3 | 10 ± 4 | 120 | +1.3 % | "
             "0.14 | 0.15 | 16 | 6.2 | 170 | 18 k | 2.5 M | 20");
  ExpectText(html, "−50 %");
}

TEST_F(ReportSections, TheMachineHasItsCommands) {
  results_.processor = "Z80";
  results_.cores = 9;
  results_.system = "CP/M";
  results_.program = "exphoton 7";
  results_.fingerprint = "f00";
  results_.command = "exphoton study room";
  const Html html = MachineSection(results_, analysis_);
  ExpectText(html, "Z80, 9 cores, CP/M; exphoton 7 (build f00), 5 threads a render");
  ExpectText(html, "exphoton study room # the reference");
  ExpectText(html,
             "seeds of their own make it # each setting, here with its first seed command 0 "
             "command 1 command 2");
}

TEST_F(ReportSections, PicturesSayHowFarTheyAreOff) {
  EXPECT_EQ(OffText(1.9, "time", "time"), "");
  EXPECT_EQ(OffText(.6, "time", "time"), "");
  EXPECT_EQ(OffText(3.2, "time", "time"), "closest: 3.2 times the time");
  EXPECT_EQ(OffText(.25, "error", "error"), "closest: 25 % of the error");
}

TEST_F(ReportSections, PicturesTenTimesOffAreLeftOutAtEqualError) {
  analysis_.target = .03;
  const std::string folder = folder_.Path();
  std::string text = TextOf(PictureSection(folder, results_, analysis_));
  const std::size_t equal = text.find("Equal error: about 0.03");
  ASSERT_NE(equal, std::string::npos) << text;
  EXPECT_EQ(text.find("photons 2 s", equal), std::string::npos) << text;
  EXPECT_NE(text.find("times off: photons (closest 0.3).", equal), std::string::npos) << text;
  analysis_.target = .05;
  text = TextOf(PictureSection(folder, results_, analysis_));
  EXPECT_NE(text.find("closest: 6 times the error; spp=8"), std::string::npos) << text;
  EXPECT_EQ(text.find("times off"), std::string::npos) << text;
}

TEST_F(ReportSections, NoPictureIsAloneInARow) {
  const auto columns = [&] {
    const std::string markup = PictureSection(folder_.Path(), results_, analysis_).Markup();
    const std::size_t at = markup.find("pictures n");
    return markup.substr(at + 9, 2);
  };
  EXPECT_EQ(columns(), "n3");  // the reference and two lines
  analysis_.lines.push_back({"more", {0}, {}, {}});
  EXPECT_EQ(columns(), "n4");
  analysis_.lines.push_back({"even more", {0}, {}, {}});
  EXPECT_EQ(columns(), "n3");
}

}  // namespace
}  // namespace exphoton::study
