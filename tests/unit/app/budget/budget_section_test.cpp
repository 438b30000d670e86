// SPDX-License-Identifier: BSD-2-Clause
// These tests print a budget whose numbers are known, and put it on a study's page.
#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

#include "core/app/budget/budget_text.h"
#include "core/app/report/page_sections.h"

namespace exphoton::cli {
namespace {

MeasuredBudget KnownBudget() {
  MeasuredBudget budget;
  budget.integrator = "exphotonmap";
  budget.width = 48, budget.height = 36, budget.samples = 4;
  ErrorBudget& parts = budget.budget;
  parts.parts = {{ErrorCause::CameraSampling, {.0012, .0001}, {}},
                 {ErrorCause::PhotonNoise, {-.00001, .0001}, {}},
                 {ErrorCause::Blur, {.0008, .0001}, {.0008, .0001}},
                 {ErrorCause::Sharing, {-.0003, .00001}, {.0001, .0001}}};
  parts.noise = {.0016, .0001}, parts.bias = {.0009, .0001}, parts.sum = {.0025, .0001};
  parts.blockWidth = 4;
  budget.measured.sum = {.0027, .0002};
  budget.measured.insideBlocks = {.0004, .0001};
  budget.isByReference = true;
  budget.costs.maps = 1, budget.costs.camera = 2, budget.costs.rays = 3;
  budget.costs.lowerBound = 1.5;
  return budget;
}

TEST(BudgetText, HasARowForEachCauseAndTheSum) {
  const std::vector<BudgetRow> rows = BudgetRows(KnownBudget(), 8);
  ASSERT_EQ(rows.size(), 11u);
  EXPECT_EQ(rows[0].value, "0.00120");
  EXPECT_EQ(rows[0].halfWidth, "0.00024");  // Student's t with 7 degrees of freedom: 2.365
  EXPECT_EQ(rows[0].share, "48 %");
  EXPECT_EQ(rows[0].halving, "+2 s: twice the samples with half the gather rays each");
  EXPECT_EQ(rows[1].halving, "no gather rays");
  EXPECT_EQ(rows[2].halving, "not distinct from 0");
  EXPECT_EQ(rows[2].share, "0 %");
  EXPECT_EQ(rows[3].halving, "+0.41 s: more photons");  // the root of 2 times the photons
  EXPECT_EQ(rows[5].halving, "reduces the other biases");
  EXPECT_EQ(rows[8].value, "0.00250");
  EXPECT_EQ(rows[10].value, "-0.00020");
  EXPECT_EQ(rows[10].halfWidth, "0.00053");  // 2.365 times the root of .0001^2 + .0002^2
}

// Counts the characters of a line in UTF-8.
std::size_t ColumnsOf(const std::string& line) {
  return std::size_t(
      std::count_if(line.begin(), line.end(), [](char c) { return (c & 0xC0) != 0x80; }));
}

// -.0000001 would be "-0.00000". A hint that exceeds the line continues under itself.
TEST(BudgetText, HasNoNegativeZeroAndNoLongLine) {
  MeasuredBudget budget = KnownBudget();
  budget.budget.parts[1].share = {-1e-7, 1e-4};
  budget.budget.parts[3].share = {.0003, .00001};
  EXPECT_EQ(BudgetRows(budget, 8)[2].value, "0.00000");
  const std::string text =
      BudgetText(std::string(70, 'a') + "/" + std::string(20, 'b') + ".pbrt", budget, {});
  EXPECT_NE(text.find(std::string(51, ' ') + "the same noise\n"), std::string::npos) << text;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) EXPECT_LE(ColumnsOf(line), 100u) << line;
}

TEST(BudgetText, OfABlackSceneHasNoShares) {
  MeasuredBudget budget = KnownBudget();
  for (ErrorPart& part : budget.budget.parts) part.share = {0, 0};
  budget.budget.noise = budget.budget.bias = budget.budget.sum = {0, 0};
  EXPECT_EQ(BudgetRows(budget, 8)[0].share, "0 %");
  const std::string text = BudgetText("black.pbrt", budget, {});
  EXPECT_EQ(text.find("nan"), std::string::npos) << text;
}

TEST(BudgetText, StatesErrorAndLowerBound) {
  EXPECT_EQ(BudgetHeadline(KnownBudget()),
            "error 5 % = noise 4 %, bias 3 %; 6 s of CPU time, 4 times the lower bound of 1.5 s");
  const std::string text = BudgetText("room.pbrt", KnownBudget(), {});
  EXPECT_NE(text.find("room.pbrt, 48 x 36 pixels, 4 samples a pixel, exphotonmap\n"),
            std::string::npos)
      << text;
  EXPECT_NE(text.find("blocks of 4 x 4 pixels"), std::string::npos) << text;
  EXPECT_NE(text.find("in no part: 0.0004"), std::string::npos) << text;
}

TEST(BudgetSection, StaysTheSameInJson) {
  study::Results results;
  EXPECT_TRUE(study::BudgetSection(results).IsEmpty());
  const MeasuredBudget budget = KnownBudget();
  results.budgets = {
      {"exphotonmap", BudgetHeadline(budget), BudgetRows(budget, 8), BudgetNotes(budget, {})}};
  const std::string page = study::BudgetSection(results).Markup();
  for (const char* text :
       {"<h3>exphotonmap</h3>", "error 5 %", "<td>0.00120</td>", "no gather rays",
        "<li>biases are those of means over blocks of 4 x 4 pixels</li>"})
    EXPECT_NE(page.find(text), std::string::npos) << text << page;
  EXPECT_EQ(study::BudgetSection(study::FromJson(study::ToJson(results))).Markup(), page);
}

// A page has one lower bound of each integrator.
TEST(BudgetSection, LeavesTheLowerBoundToTheStudy) {
  study::Results results;
  results.settings = {{"path", "path", {}}, {"exphotonmap", "exphotonmap", {}}};
  const MeasuredBudget budget = KnownBudget();
  for (const char* integrator : {"exphotonmap", "photonmap"})
    results.budgets.push_back(
        {integrator, BudgetHeadline(budget), BudgetRows(budget, 8), BudgetNotes(budget, {})});
  const auto countIn = [&](const std::string& part) {
    const std::string page = study::BudgetSection(results).Markup();
    int count = 0;
    for (std::size_t at = 0; (at = page.find(part, at)) != std::string::npos; ++at) ++count;
    return count;
  };
  EXPECT_EQ(countIn("4 times the lower bound of 1.5 s"), 2);
  EXPECT_EQ(countIn("<li>the lower bound is"), 2);
  results.lowerBounds = {{1, .5, 1, ""}};
  EXPECT_EQ(countIn("4 times the lower bound of 1.5 s"), 1);
  EXPECT_EQ(countIn("<li>the lower bound is"), 1);
  EXPECT_EQ(countIn("6 s of CPU time</p>"), 1);
  EXPECT_EQ(countIn("<li>the line below the headline has the lower bound"), 1);
}

}  // namespace
}  // namespace exphoton::cli
