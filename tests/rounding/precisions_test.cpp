// SPDX-License-Identifier: BSD-2-Clause
// Tests of the comparison of precisions, with pictures whose errors are known.
#include "tests/rounding/measure/precisions.h"

#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

#include "tests/rounding/measure/results.h"

namespace exphoton::rounding {
namespace {

// Four grey pixels of value 1. The first has the error given.
std::vector<double> PictureWithError(double error) {
  std::vector<double> picture(12, 1);
  picture[1] += error;
  return picture;
}

TEST(PrecisionDistance, CountsRoundingsAndDecisions) {
  const std::vector<double> truth = PictureWithError(0);
  const Distance rounded = DistanceOf({PictureWithError(0x1p-40)}, truth);
  EXPECT_EQ(rounded.between, 0);
  EXPECT_EQ(rounded.decided, 0);
  const Distance between = DistanceOf({PictureWithError(0x1p-20), truth}, truth);
  EXPECT_EQ(between.between, .25);
  EXPECT_EQ(between.decided, 0);
  const Distance decided = DistanceOf({truth, PictureWithError(-.5)}, truth);
  EXPECT_EQ(decided.between, 0);
  EXPECT_EQ(decided.decided, .25);
  EXPECT_EQ(decided.median, 0);
}

TEST(PrecisionDistance, IsRelativeToThePixel) {
  std::vector<double> off(12, 2);
  for (double& value : off) value += 0x1p-19;
  EXPECT_NEAR(DistanceOf({off}, std::vector<double>(12, 2)).median, 0x1p-20 / 1.01, 0x1p-40);
}

TEST(PrecisionDistance, OfBlackPicturesIsZero) {
  const std::vector<double> black(12, 0);
  EXPECT_EQ(DistanceOf({black}, black).decided, 0);
}

TEST(Precisions, ShrinkByTheRatioOfTheMedians) {
  const std::vector<double> one(12, 1), inFloat(12, 1 + 0x1p-20), inDouble(12, 1 + 0x1p-48);
  const auto rows = ComparePrecisions({{"a", {inFloat}}, {"b", {one}}}, {{"a", {one, inDouble}}});
  ASSERT_EQ(rows.size(), 1u);
  EXPECT_NEAR(rows[0].Shrinks(), -28, 1e-9);
  EXPECT_NE(TextOf(rows).find("| a | 7.9 | 0.0 % | 16 | 0.0 % | 0.0 % | 2^-28.0 |"),
            std::string::npos)
      << TextOf(rows);
}

TEST(Precisions, AreReadAsWritten) {
  std::ostringstream out;
  Write({"a b", {{1. / 3, 0x1p-1074, 0}, {1, 2, 3}}}, out);
  Write({"c", {{4, 5, 6}}}, out);
  std::istringstream in(out.str());
  const auto scenes = ReadPictures(in);
  ASSERT_EQ(scenes.size(), 2u);
  EXPECT_EQ(scenes[0].name, "a b");
  EXPECT_EQ(scenes[0].pictures,
            (std::vector<std::vector<double>>{{1. / 3, 0x1p-1074, 0}, {1, 2, 3}}));
  EXPECT_EQ(scenes[1].pictures.size(), 1u);
}

TEST(RoundingSubjects, NameEachHardCaseOnceOrLeaveItOut) {
  const Subjects subjects = ReadHardCases();
  EXPECT_GT(subjects.all.size(), 200u);
  const std::string text = LeftOutText(subjects.leftOut);
  EXPECT_NE(text.find("- is a script, with renders of its own: 17 drift, "), std::string::npos);
  EXPECT_NE(text.find("3 vertex (4),"), std::string::npos) << text;
  EXPECT_NE(text.find("- has tests of parts, and no scene: 7, 8,"), std::string::npos) << text;
}

}  // namespace
}  // namespace exphoton::rounding
