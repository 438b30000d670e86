// SPDX-License-Identifier: BSD-2-Clause
// These tests read the sections of a study's page as a reader does: the text of each table row.
#include "core/app/report/page_sections.h"

#include <gtest/gtest.h>

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

void ExpectText(const Html& html, const std::string& part) {
  EXPECT_NE(TextOf(html).find(part), std::string::npos) << part << "\nnot in\n" << TextOf(html);
}

SettingResult MakeSetting(std::size_t setting, double seconds, double error) {
  SettingResult s;
  s.setting = setting;
  s.runs = {setting};
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
      row.command = "command " + std::to_string(i);
      results_.runs.push_back(row);
      results_.runs.push_back(row);
      results_.runs.back().command = "another seed";
    }
    analysis_.hasReference = true;
    analysis_.headline = "The <headline>.";
    analysis_.reference.variance = {.0004, .0001};
    analysis_.settings = {MakeSetting(0, 1, .4), MakeSetting(1, 4, .04), MakeSetting(2, 2, .3)};
    analysis_.lines = {{"path", {0, 1}, {}}, {"photons", {2}, {}}};
  }

  Results results_;
  Analysis analysis_;
};

TEST_F(ReportSections, HeadlineNamesTheReferenceAndTheRenders) {
  Html html = HeadlineSection(results_, analysis_);
  ExpectText(html, "The &lt;headline&gt;.");
  ExpectText(html, "path, 50 k samples a pixel the reference, in 10.7 min");
  ExpectText(html, "0.0004 relMSE of the reference's own noise");
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
  html = HeadlineSection(results_, analysis_);
  ExpectText(html, "5 pixels are NaN or infinite and were left out");
  ExpectText(html, "a given picture the reference unknown noise of the reference");
  ExpectText(html, "times are seconds of the whole process");
  EXPECT_EQ(TextOf(html).find("variant of the scene"), std::string::npos);
  analysis_.hasReference = false;
  html = HeadlineSection(results_, analysis_);
  ExpectText(html, "No reference only the noise between seeds is known");
  ExpectText(html, "Noise is measured between seeds");
}

TEST_F(ReportSections, ASceneWithTheSameContentIsNoVariant) {
  results_.reference.sceneHash = "1";
  EXPECT_EQ(TextOf(HeadlineSection(results_, analysis_)).find("variant"), std::string::npos);
}

TEST_F(ReportSections, CurvesNumberTheFrontByTime) {
  const Html html = CurveSection(results_, analysis_);
  ExpectText(html, "| 1 | path | spp=4 | 1 ± 0.1 | 0.4 ± 0.04");
  ExpectText(html, "| 2 | photons | spp=8 | 2 ± 0.2 | 0.3 ± 0.03");
  ExpectText(html, "| 3 | path | spp=16 | 4 ± 0.4 | 0.04 ± 0.004");
  ExpectText(html, "photons, spp=8: 2 s, 0.3");  // the title of a mark
}

TEST_F(ReportSections, BarsShowTimeAndErrorOfEachSetting) {
  for (SettingResult& s : analysis_.settings)
    s.phases = {{"render", .75 * s.cost.seconds.value},
                {"new", .125 * s.cost.seconds.value},
                {"other", .125 * s.cost.seconds.value}};
  const Html html = BarSection(results_, analysis_);
  ExpectText(html, "write new other noise (variance");
  ExpectText(html, "| 4 s |");
  // The efficiency of the second setting is ten times for a fourth of the seconds.
  ExpectText(html, "| 0.03 ± 0.003 | 0.01 ± 0.004 | 2.5×");
  ExpectText(html, "| 0.3 ± 0.003 | 0.1 ± 0.004 | 1×");
  ExpectText(html, "render: 3 s");
  ExpectText(html, "new: 0.5 s");
  ExpectText(html, "noise: 0.03");
  ExpectText(html, "bias²: 0.1");
  // Bars are shares of the longest, at most four times the median: 4 s, .4.
  EXPECT_NE(html.Markup().find("\"75%\""), std::string::npos);
  EXPECT_NE(html.Markup().find("\"18.75%\""), std::string::npos);
}

TEST_F(ReportSections, PricesNameTheCheapestSettingOfEachLine) {
  analysis_.settings[0].peakMemory = 3 << 20;
  analysis_.settings[1].peakMemory = 5 << 20;
  analysis_.settings[2].peakMemory = 7 << 20;
  analysis_.settings[2].photonsStored = 12000;
  const Html html = PriceSection(results_, analysis_);
  ExpectText(html, "| 0.5 | 1 s spp=4 3 MiB | 2 s spp=8 7 MiB, 12 k photons");
  ExpectText(html, "| 0.05 | 4 s spp=16 5 MiB | –");
  ExpectText(html,
             "| 0.0005 | refused: the reference's noise is 80 % of this; one rendered 8 times");
  EXPECT_NE(html.Markup().find("<span class=\"best\">1 s</span>"), std::string::npos);
  EXPECT_EQ(html.Markup().find("<span class=\"best\">2 s</span>"), std::string::npos);
  // Two doublings cost 3 seconds and divide the error by 10.
  ExpectText(html, "path | spp | +1.5 s | −68 % | 1");
}

TEST_F(ReportSections, ThePricesOfDoublingsAreOrderedAsTheLines) {
  results_.settings.push_back({"photons", "photonmap", {{"spp", "4"}}});
  results_.settings.push_back({"absent", "igi", {}});
  analysis_.settings.push_back(MakeSetting(3, 3, .2));
  analysis_.lines = {{"photons", {2, 3}, {}}, {"path", {0, 1}, {}}};
  const std::string text = TextOf(PriceSection(results_, analysis_));
  // Half of the samples cost a second more and have two thirds of the error.
  const std::size_t photons = text.find("photons | spp | −1 s | +50 % | 1");
  ASSERT_NE(photons, std::string::npos) << text;
  EXPECT_GT(text.find("path | spp | +1.5 s"), photons);
}

TEST_F(ReportSections, DataNameMachineCommandsAndEveryValue) {
  results_.processor = "Z80";
  results_.cores = 9;
  results_.system = "CP/M";
  results_.program = "exphoton 7";
  results_.fingerprint = "f00";
  results_.command = "exphoton study room";
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
  const Html html = DataSection(results_, analysis_);
  ExpectText(html, "Z80, 9 cores, CP/M; exphoton 7 (build f00), 5 threads a render");
  ExpectText(html, "exphoton study room # the reference");
  ExpectText(html,
             "seeds of their own make it # each setting, here with its first seed command 0 "
             "command 1 command 2");
  ExpectText(html,
             "path spp=16 | 4 ± 0.4 | 2 ± 0.2 | 0.041 ± 0.002 | 0.11 | 0.03 ± 0.003 | 0.01 ± "
             "0.004 | 0.12 | +1.3 % | 0.14 | 0.15 | 16 | 6.2 | 170 | 18 k | 2.5 M | 20");
  ExpectText(html, "−50 %");
}

TEST_F(ReportSections, CountsAreShort) {
  EXPECT_EQ(CountText(9999), "9999");
  EXPECT_EQ(CountText(10000), "10 k");
  EXPECT_EQ(CountText(123456), "123 k");
  EXPECT_EQ(CountText(1e6), "1 M");
  EXPECT_EQ(TextOf(MeasuredText({2, .25})), "2 ± 0.2 ");
  EXPECT_EQ(TextOf(MeasuredText({2, kUnknown})), "2");
  EXPECT_EQ(TextOf(MeasuredText({})), "–");
}

}  // namespace
}  // namespace exphoton::study
