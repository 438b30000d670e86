// SPDX-License-Identifier: BSD-2-Clause
// Tests of the measurement of lost digits with pictures and rows whose spread is known.
#include "tests/rounding/measure/spread.h"

#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

#include "tests/rounding/measure/results.h"

namespace exphoton::rounding {
namespace {

// Pictures of 4 x 1 grey pixels of value 1. In picture i, the first pixel has the value given.
std::vector<Image> PicturesWithPixel(const std::vector<float>& values) {
  std::vector<Image> pictures;
  for (const float value : values) {
    Image image(4, 1, {"R", "G", "B", "A"});
    for (float& each : image.pixels) each = 1;
    for (int channel = 0; channel < 3; ++channel) image.At(0, 0, channel) = value;
    pictures.push_back(image);
  }
  return pictures;
}

TEST(RoundingSpread, IsZeroForEqualPictures) {
  const Spread spread = SpreadOf(PicturesWithPixel({1, 1, 1}));
  EXPECT_EQ(spread.mean, 0);
  EXPECT_EQ(spread.worst, 0);
  EXPECT_EQ(spread.decided, 0);
}

TEST(RoundingSpread, IsTheStandardDeviationInUnitsOfEpsilon) {
  // Two values at distance d have the standard deviation d / sqrt(2).
  const float d = 0x1p-12f;
  const Spread spread = SpreadOf(PicturesWithPixel({1, 1 + d}));
  const double deviation = double(d) / std::sqrt(2) / 0x1p-23;
  EXPECT_NEAR(spread.worst, std::log10(deviation / 1.01), .001);
  EXPECT_NEAR(spread.mean, std::log10(deviation / 4), .001);
  EXPECT_EQ(spread.median, 0);
  EXPECT_EQ(spread.decided, 0);
}

TEST(RoundingSpread, CountsPixelsWhoseDecisionsTurnedOut) {
  const Spread spread = SpreadOf(PicturesWithPixel({1, 2, 1}));
  EXPECT_EQ(spread.decided, .25);
  EXPECT_GT(spread.worst, 6);
}

TEST(RoundingSpread, OfNoLightIsZero) {
  std::vector<Image> pictures(2, Image(2, 2, {"R", "G", "B", "A"}));
  EXPECT_EQ(SpreadOf(pictures).worst, 0);
}

Result ResultOf(const std::string& name, double mean, double median) {
  return {{"group", name, "text", ""}, {mean, median, 3, 0}};
}

TEST(RoundingLimits, HoldForTheWorstRunOfACase) {
  const std::vector<Row> rows =
      RowsOf({ResultOf("1 a", 1, 2), ResultOf("1 b", 2, 1), ResultOf("2 a", 0, 0)});
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_EQ(rows[0].name, "1");
  EXPECT_EQ(rows[0].runs, 2);
  EXPECT_EQ(rows[0].most.mean, 2);
  EXPECT_EQ(rows[0].most.median, 2);
  EXPECT_TRUE(Excesses(rows, {{2, 2, "1"}, {0, 0, "2"}}).empty());
}

TEST(RoundingLimits, NameRowsAboveThemAndRowsWithoutOne) {
  const std::vector<Row> rows =
      RowsOf({ResultOf("1 a", 1, 2), ResultOf("2 a", 1, 2), ResultOf("3 a", 1, 2)});
  const auto excesses = Excesses(rows, {{.9, 2, "1"}, {1, 1.9, "2"}});
  ASSERT_EQ(excesses.size(), 3u);
  EXPECT_EQ(excesses[0], "1: the mean loses 1.00 digits, the limit is 0.9");
  EXPECT_EQ(excesses[1], "2: the median pixel loses 2.00 digits, the limit is 1.9");
  EXPECT_EQ(excesses[2], "3 has no limit");
}

TEST(RoundingResults, AreReadFromTheLinesOfAnEarlierRun) {
  const Result result{{"group", "1 a", "text", ""}, {1.25, 2.5, 3, .5}, 1};
  std::istringstream in("some other line\n" + LineOf(result) + "\n");
  EarlierLines lines(in);
  EXPECT_FALSE(lines.Take({"group", "1 b", "text", ""}));
  const auto spread = lines.Take(result.subject);
  ASSERT_TRUE(spread);
  EXPECT_NEAR(spread->mean, 1.25, .051);
  EXPECT_EQ(spread->median, 2.5);
  EXPECT_EQ(spread->worst, 3);
  EXPECT_EQ(spread->decided, .5);
  EXPECT_FALSE(lines.Take(result.subject));
}

TEST(RoundingLimits, NameLimitsOfWhatWasNotMeasured) {
  const std::vector<Row> rows = RowsOf({ResultOf("1 a", 1, 2)});
  EXPECT_EQ(NotMeasured(rows, {{1, 1, "1"}, {1, 1, "cloister path"}}),
            std::vector<std::string>{"cloister path"});
}

}  // namespace
}  // namespace exphoton::rounding
