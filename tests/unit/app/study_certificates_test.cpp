// SPDX-License-Identifier: BSD-2-Clause
// These tests put the certificates of a study's renders (--certify) beside its measured errors.
#include "core/app/analysis/certificate_checks.h"

#include <gtest/gtest.h>

#include <limits>

#include "core/app/report/page_sections.h"
#include "core/imaging/files/exr.h"
#include "tests/support/process.h"

namespace exphoton::study {
namespace {

constexpr double kUnbounded = std::numeric_limits<double>::infinity();

class StudyCertificates : public testing::Test {
 protected:
  // Blocks of 16 pixels have a bias of 2 %. The first of two intervals contains it. Blocks of 8
  // pixels have no bias, and their interval has no upper end. path has no certificate.
  StudyCertificates() {
    results_.settings = {{"photons", "exphotonmap", {{"spp", "4"}}},
                         {"photons", "exphotonmap", {{"spp", "16"}}},
                         {"path", "path", {{"spp", "4"}}}};
    AddRun(0, Stated(.05, .01, .03));
    AddRun(0, Stated(.07, .03, .05));
    AddRun(1, {{"noise", .1}, {"blockWidth", 8}, {"blockBiasLower", 0}});
    AddRun(2, {});
    analysis_.hasReference = true;
    analysis_.lines = {{"photons", {0, 1}, {}, "exphotonmap"}, {"tracer", {2}, {}, "path"}};
    analysis_.settings[0].cost.error = {.0036, .0001};
    analysis_.settings[0].separation.bias2 = {.0009, kUnknown};
    analysis_.settings[0].blockBias = {{16, {.0004, .0001}}};
    analysis_.settings[1].blockBias = {{8, {-.0001, .0001}}};
  }
  static NamedValues Stated(double error, double lower, double upper) {
    return {
        {"error", error}, {"blockWidth", 16}, {"blockBiasLower", lower}, {"blockBiasUpper", upper}};
  }
  void AddRun(std::size_t setting, const NamedValues& certificate) {
    if (setting == analysis_.settings.size()) analysis_.settings.emplace_back();
    analysis_.settings[setting].setting = setting;
    analysis_.settings[setting].runs.push_back(results_.runs.size());
    RunRow row;
    row.setting = setting;
    row.seed = results_.runs.size();
    row.certificate = certificate;
    results_.runs.push_back(row);
  }
  void ExpectOnPage(const std::vector<std::string>& texts) const {
    const std::string page = CertificateSection(results_, analysis_).Markup();
    for (const std::string& text : texts)
      EXPECT_NE(page.find(text), std::string::npos) << text << "\nnot in\n" << page;
  }

  Results results_;
  Analysis analysis_;
};

TEST_F(StudyCertificates, AreComparedWithTheBiasOfTheirOwnBlocks) {
  const auto checks = CheckCertificates(results_, analysis_);
  ASSERT_EQ(checks.size(), 2u);
  EXPECT_EQ(checks[0].setting, 0u);
  EXPECT_EQ(checks[0].compared, 2);
  EXPECT_EQ(checks[0].contained, 1);
  EXPECT_EQ(checks[0].leastWidth, 16);
  EXPECT_EQ(checks[0].mostWidth, 16);
  EXPECT_NEAR(checks[0].error, (.05 * .05 + .07 * .07) / 2, 1e-12);
  EXPECT_NEAR(checks[0].lower, (.01 * .01 + .03 * .03) / 2, 1e-12);
  EXPECT_NEAR(checks[0].upper, (.03 * .03 + .05 * .05) / 2, 1e-12);
  EXPECT_NEAR(checks[0].blockBias.value, .0004, 1e-12);
  EXPECT_NEAR(checks[0].blockBias.error, .0001, 1e-12);
  // A negative estimate is a bias of 0.
  EXPECT_EQ(checks[1].contained, 1);
  EXPECT_EQ(checks[1].upper, kUnbounded);
  EXPECT_EQ(checks[1].error, kUnbounded);
}

TEST_F(StudyCertificates, AreOnThePage) {
  ExpectOnPage(
      {"<h2>Certificates</h2> <span>2 of 3 intervals contain the measured bias of blocks 8 "
       "to 16 pixels wide</span>",
       "<td>6.00 <small>± 0.08</small></td><td>6.1</td><td>3</td><td>16</td>",
       "<td>2.0 <small>± 0.2</small></td><td>2.2 to 4.1</td><td>1 of 2</td>",
       "<td>unknown</td><td>–</td><td>8</td>",
       "<td>0 <small>± 1</small></td><td>0 to no known end</td><td>1 of 1</td>"});
  EXPECT_EQ(CertificateSection(results_, analysis_).Markup().find("tracer"), std::string::npos);
  for (RunRow& row : results_.runs) row.certificate.clear();
  EXPECT_TRUE(CertificateSection(results_, analysis_).IsEmpty());
}

TEST_F(StudyCertificates, AreNotComparedWithoutAReference) {
  analysis_.hasReference = false;
  for (SettingResult& setting : analysis_.settings)
    setting.blockBias.clear(), setting.separation.bias2 = {};
  ExpectOnPage({"not compared, because the bias is not known",
                "<td>–</td><td>6.1</td><td>–</td><td>16</td>",
                "<td>–</td><td>2.2 to 4.1</td><td>–</td>"});
}

TEST_F(StudyCertificates, StayTheSameInJson) {
  const Results read = FromJson(ToJson(results_));
  ASSERT_EQ(read.runs.size(), 4u);
  for (std::size_t i = 0; i < 4; ++i)
    EXPECT_EQ(read.runs[i].certificate, results_.runs[i].certificate);
  EXPECT_EQ(RowFromJson(RowToJson(results_.runs[1])).certificate, results_.runs[1].certificate);
  EXPECT_EQ(RowToJson(results_.runs[3]).find("certificate"), std::string::npos);
}

TEST_F(StudyCertificates, ComeFromTheStatisticsOfARender) {
  RunRow row;
  AddRunStatistics(R"({"certificate":{"error":0.02,"biasUpper":null,"blockWidth":8,
    "notCovered":["caustics"]}})",
                   &row);
  EXPECT_EQ(row.certificate, (NamedValues{{"error", .02}, {"blockWidth", 8}}));
}

TEST_F(StudyCertificates, HaveColumnsInTheTableOfRenders) {
  std::string csv = ToCsv(results_);
  for (const char* name : {"error", "noise", "blockWidth", "blockBiasLower", "blockBiasUpper"})
    EXPECT_NE(csv.substr(0, csv.find('\n')).find(std::string(",certificate: ") + name + ","),
              std::string::npos)
        << csv;
  // Sorted: blockBiasLower, blockBiasUpper, blockWidth, error, noise. The metrics are unknown.
  EXPECT_NE(csv.find(",0.01,0.03,16,0.05,,,"), std::string::npos) << csv;
  EXPECT_NE(csv.find(",0,,8,,0.1,,"), std::string::npos) << csv;
  for (RunRow& row : results_.runs) row.certificate.clear();
  csv = ToCsv(results_);
  EXPECT_EQ(csv.find("certificate"), std::string::npos) << csv;
}

// Each picture is brighter than the reference by .1 in its left half, and darker in its right one.
TEST_F(StudyCertificates, DecideWhichBlocksAreMeasured) {
  const TestFolder folder;
  const auto write = [&](const std::string& name, float bias) {
    Image image(16, 8, {"R", "G", "B"});
    for (int y = 0; y < 8; ++y)
      for (int x = 0; x < 16; ++x)
        for (int c = 0; c < 3; ++c) image.At(x, y, c) = x < 8 ? 1 + bias : 1 - bias;
    WriteExr(folder.File(name), image, false);
  };
  write("reference.exr", 0);
  write("picture.exr", .1f);
  results_.reference.a = results_.reference.b = "reference.exr";
  AddRun(1, {{"blockWidth", 16}});
  for (RunRow& row : results_.runs) row.image = "picture.exr", row.cpuSeconds = 1;
  const Analysis analysis = Analyse(folder.Path(), results_);
  ASSERT_EQ(analysis.settings.size(), 3u);
  const std::map<int, Measured>& biases = analysis.settings[1].blockBias;
  ASSERT_EQ(biases.size(), 2u);
  EXPECT_NEAR(biases.at(8).value, .01 / 1.01, 1e-6);
  EXPECT_NEAR(biases.at(16).value, 0, 1e-6);
  EXPECT_TRUE(analysis.settings[2].blockBias.empty());
  results_.reference = {};
  EXPECT_TRUE(Analyse(folder.Path(), results_).settings[1].blockBias.empty());
}

}  // namespace
}  // namespace exphoton::study
