// SPDX-License-Identifier: BSD-2-Clause
// These tests check which pixels show more than one surface, and what their samples contribute.
#include "core/render/edges/edge_pixels.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/render/sharing/gather_fragments.h"
#include "tests/support/test_scene.h"

namespace exphoton {
namespace {

constexpr int kWidth = 16;

// An orthographic view of the square from (-1,-1) to (1,1), along +z. Pixels are an eighth wide.
std::string View(const std::string& filter) {
  return "Camera \"orthographic\"\nFilm \"image\" \"integer xresolution\" 16 \"integer "
         "yresolution\" 16\nPixelFilter " +
         filter + "\nWorldBegin\n";
}

const std::string kWall =
    "Shape \"trianglemesh\" \"integer indices\" [0 1 2 0 2 3] \"point P\" "
    "[-9 -9 5  9 -9 5  9 9 5  -9 9 5]\n";

int EdgesIn(const std::string& text, bool Expected(int x, int y)) {
  const LoadedScene scene = LoadSceneText(text + "WorldEnd\n");
  const RenderSetup& setup = *scene.setup;
  const EdgePixels edges(*setup.scene, *setup.camera, *setup.filter, {0, 0, kWidth, kWidth});
  int found = 0;
  for (int y = 0; y < kWidth; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      EXPECT_EQ(edges.Has({x, y}), Expected(x, y)) << x << "," << y;
      found += edges.Has({x, y});
    }
  }
  return found;
}

TEST(EdgePixels, AFlatWallHasNone) {
  EXPECT_EQ(EdgesIn(View("\"box\"") + kWall, [](int, int) { return false; }), 0);
}

TEST(EdgePixels, NothingButTheSkyHasNone) {
  EXPECT_EQ(EdgesIn(View("\"box\""), [](int, int) { return false; }), 0);
}

TEST(EdgePixels, ABarBeforeAWallHasThemWhereItEnds) {
  // Its ends lie in the columns 4 and 10.
  const std::string bar =
      "Shape \"trianglemesh\" \"integer indices\" [0 1 2 0 2 3] \"point P\" "
      "[-.45 -9 4  .35 -9 4  .35 9 4  -.45 9 4]\n";
  EXPECT_EQ(EdgesIn(View("\"box\"") + kWall + bar, [](int x, int) { return x == 4 || x == 10; }),
            2 * kWidth);
  // Before the sky as well.
  EXPECT_EQ(EdgesIn(View("\"box\"") + bar, [](int x, int) { return x == 4 || x == 10; }),
            2 * kWidth);
  // A filter of four pixels sees the bar from the nearer half of the next column.
  EXPECT_EQ(EdgesIn(View("\"gaussian\" \"float xwidth\" 2") + kWall + bar,
                    [](int x, int) { return x == 3 || x == 4 || x == 10 || x == 11; }),
            4 * kWidth);
}

TEST(EdgePixels, MaterialsOnOnePlaneMeetInThem) {
  const std::string halves =
      "Shape \"trianglemesh\" \"integer indices\" [0 1 2 0 2 3] \"point P\" "
      "[-9 -9 5  .05 -9 5  .05 9 5  -9 9 5]\nMaterial \"mirror\"\n"
      "Shape \"trianglemesh\" \"integer indices\" [0 1 2 0 2 3] \"point P\" "
      "[.05 -9 5  9 -9 5  9 9 5  .05 9 5]\n";
  EXPECT_EQ(EdgesIn(View("\"box\"") + halves, [](int x, int) { return x == 8; }), kWidth);
}

TEST(EdgePixels, AFoldOfOneMaterialIsOne) {
  const std::string fold =
      "Shape \"trianglemesh\" \"integer indices\" [0 1 2 0 2 3 4 0 3 4 3 5] \"point P\" "
      "[.05 -9 5  9 -9 14  9 9 14  .05 9 5  -9 -9 14  -9 9 14]\n";
  EXPECT_EQ(EdgesIn(View("\"box\"") + fold, [](int x, int) { return x == 8; }), kWidth);
}

TEST(GatherShares, FourQuartersAreOneRecord) {
  GatherRecord record;
  record.ng = record.n = Normal3(0, 0, 1);
  record.weight = Spectrum(1);
  GatherFragments gathers({0, 0, 2, 1}, 4);
  for (int i = 0; i < 4; ++i) {
    record.light = Spectrum(Real(1 + i));
    gathers.At({0, 0}).Add({record}, {Real(.2), Real(.5)}, 1, {2, Real(.25)});
  }
  record.light = Spectrum(Real(2.5));
  gathers.At({1, 0}).Add({record}, {Real(.2), Real(.5)}, 1, {2});
  for (const int x : {0, 1}) {
    gathers.At({x, 0}).Finish();
    const GatherFragment& fragment = gathers.At({x, 0}).fragments.front();
    EXPECT_EQ(fragment.Count(), 1);
    EXPECT_EQ(fragment.Mean(2).g, Real(2.5));
    EXPECT_EQ(fragment.film.x, Real(.2));
    EXPECT_EQ(fragment.n.z, 1);
  }
}

TEST(GatherShares, PartsOfARecordHaveAMean) {
  GatherRecord record;
  record.ng = record.n = Normal3(0, 0, 1);
  record.light = Spectrum(3);
  GatherFragments::Pixel pixel;
  pixel.Add({record}, {0, 0}, 1, {1, Real(.25)});
  EXPECT_EQ(pixel.fragments.front().Mean(1).g, 3);
  EXPECT_EQ(pixel.fragments.front().Mean(0).g, 0);
}

}  // namespace
}  // namespace exphoton
