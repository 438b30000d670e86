// SPDX-License-Identifier: BSD-2-Clause
// These tests check that bands cover the picture, and that each has the margin that it needs.
#include "core/render/sharing/sharing_bands.h"

#include <gtest/gtest.h>

#include "core/render/sharing/gather_fragments.h"
#include "core/render/sharing/shared_gathers.h"

namespace exphoton {
namespace {

TEST(SharingBands, CoverTheWindowOnce) {
  const PixelBounds full{0, 0, 640, 480}, window{10, 50, 400, 450};
  const PixelBounds gathered = WithSharingMargin(window, full, 0);
  int y = window.y0;
  for (const SharingBand& band : PlanBands(window, gathered, 4, 5e6)) {
    EXPECT_EQ(band.window.y0, y);
    EXPECT_EQ(band.window.x1, window.x1);
    EXPECT_EQ(band.gathered.y0, std::max(band.window.y0 - SharingMargin(), 0));
    EXPECT_EQ(band.gathered.y1, std::min(band.window.y1 + SharingMargin(), gathered.y1));
    EXPECT_EQ(band.gathered.x0, gathered.x0);
    y = band.window.y1;
  }
  EXPECT_EQ(y, window.y1);
}

TEST(SharingBands, TakeTheMemoryThatIsAllowed) {
  const PixelBounds window{0, 0, 1000, 5000};
  const double memory = 2e8;
  const auto bands = PlanBands(window, window, 8, memory);
  const double perPixel = GatherFragments::BytesPerPixel(8);
  ASSERT_GT(bands.size(), 2u);
  const PixelBounds& middle = bands[1].gathered;
  const double used = double(middle.Width()) * middle.Height() * perPixel;
  EXPECT_LE(used, memory);
  EXPECT_GE(used, memory - 2 * 1000 * perPixel);
}

TEST(SharingBands, AreOneWhereMemorySuffices) {
  const PixelBounds window{0, 0, 40, 30};
  EXPECT_EQ(PlanBands(window, window, 4, 0x1p28).size(), 1u);
}

}  // namespace
}  // namespace exphoton
