// SPDX-License-Identifier: BSD-2-Clause
// These tests check the places of labels in charts, and which parts of pictures are enlarged.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/app/report/chart/chart_frame.h"
#include "core/app/report/chart/label_placer.h"
#include "core/app/report/page_pictures.h"

namespace exphoton::study {
namespace {

constexpr double kWidth = 30, kHeight = 10;

TEST(LabelPlacer, PutsAFirstLabelToTheRight) {
  LabelPlacer placer({0, 0, 200, 100});
  const auto at = placer.Place({50, 50}, kWidth, kHeight);
  ASSERT_TRUE(at);
  EXPECT_NEAR(at->x, 50 + kWidth / 2 + 3, 1e-9);
  EXPECT_NEAR(at->y, 50, 1e-9);
}

TEST(LabelPlacer, CoversNoMarkAndNoOtherLabel) {
  LabelPlacer placer({0, 0, 200, 100});
  placer.Block({54, 40, 60, 60});  // a mark to the right
  std::vector<Point2d> places;
  for (int i = 0; i < 6; ++i) {
    const auto at = placer.Place({50, 50}, kWidth, kHeight);
    ASSERT_TRUE(at) << i;
    EXPECT_TRUE(at->x + kWidth / 2 <= 54 || at->x - kWidth / 2 >= 60 || at->y + kHeight / 2 <= 40 ||
                at->y - kHeight / 2 >= 60);
    for (const Point2d& other : places)
      EXPECT_TRUE(std::abs(at->x - other.x) >= kWidth || std::abs(at->y - other.y) >= kHeight);
    places.push_back(*at);
  }
}

TEST(LabelPlacer, StaysInsideItsArea) {
  LabelPlacer placer({0, 0, 200, 100});
  const auto at = placer.Place({199, 99}, kWidth, kHeight);
  ASSERT_TRUE(at);
  EXPECT_LE(at->x + kWidth / 2, 200);
  EXPECT_LE(at->y + kHeight / 2, 100);
}

TEST(LabelPlacer, FindsNoPlaceWhereAllIsTaken) {
  LabelPlacer placer({0, 0, 200, 100});
  placer.Block({0, 0, 200, 100});
  EXPECT_FALSE(placer.Place({50, 50}, kWidth, kHeight));
}

TEST(LabelPlacer, AvoidsLinesIfItCan) {
  LabelPlacer placer({0, 0, 200, 100});
  placer.Discourage({50, 50}, {200, 50});
  const auto at = placer.Place({50, 50}, kWidth, kHeight);
  ASSERT_TRUE(at);
  EXPECT_GE(std::abs(at->y - 50), kHeight / 2);
}

TEST(LabelPlacer, CountsLettersNotBytes) {
  EXPECT_DOUBLE_EQ(TextWidth("×²", 10), TextWidth("ab", 10));
}

TEST(ChartFrame, TicksAreShort) {
  EXPECT_EQ(TickText(.02), "0.02");
  EXPECT_EQ(TickText(.001), "0.001");
  EXPECT_EQ(TickText(1e-4), "10⁻⁴");
  EXPECT_EQ(TickText(5e-6), "5×10⁻⁶");
}

// Returns a grey picture whose pixels in a square differ from the reference, which is grey.
Image WithFault(int x0, int y0, float value) {
  Image image(320, 240, {"R", "G", "B"});
  for (int y = 0; y < 240; ++y)
    for (int x = 0; x < 320; ++x)
      for (int c = 0; c < 3; ++c) {
        const bool isFault = x >= x0 && x < x0 + 20 && y >= y0 && y < y0 + 20;
        image.At(x, y, c) = isFault ? value : .5f;
      }
  return image;
}

bool Holds(const std::array<double, 4>& window, double x, double y) {
  return window[0] * 320 <= x && x <= window[1] * 320 && window[2] * 240 <= y &&
         y <= window[3] * 240;
}

TEST(WorstWindows, AreWhereAnyPictureIsWrong) {
  const std::vector<Image> pictures{WithFault(40, 200, .9f), WithFault(250, 30, .7f)};
  const auto windows = WorstWindows(pictures, WithFault(0, 0, .5f), 2);
  ASSERT_EQ(windows.size(), 2u);
  EXPECT_TRUE(Holds(windows[0], 50, 210));
  EXPECT_TRUE(Holds(windows[1], 260, 40));
  for (const auto& [x0, x1, y0, y1] : windows) {
    EXPECT_NEAR((x1 - x0) * 320, 40, 1e-9);  // an eighth of the picture
    EXPECT_NEAR((y1 - y0) * 240, 30, 1e-9);
  }
}

TEST(WorstWindows, AreApartFromEachOther) {
  // The fault is larger than a window, but the second window is elsewhere.
  Image fault = WithFault(100, 100, .9f);
  for (int y = 100; y < 130; ++y)
    for (int x = 100; x < 180; ++x)
      for (int c = 0; c < 3; ++c) fault.At(x, y, c) = .9f;
  const auto windows = WorstWindows({fault}, WithFault(0, 0, .5f), 2);
  ASSERT_EQ(windows.size(), 2u);
  const double across = std::abs(windows[0][0] - windows[1][0]) * 320;
  const double down = std::abs(windows[0][2] - windows[1][2]) * 240;
  EXPECT_TRUE(across >= 80 || down >= 60) << across << " " << down;
}

TEST(WorstWindows, OfASmallPictureAreLargerAndCloser) {
  const Image grey(48, 36, {"R", "G", "B"});
  const auto windows = WorstWindows({grey}, grey, 2);
  ASSERT_EQ(windows.size(), 2u);
  EXPECT_NEAR((windows[0][1] - windows[0][0]) * 48, 16, 1e-9);
}

}  // namespace
}  // namespace exphoton::study
