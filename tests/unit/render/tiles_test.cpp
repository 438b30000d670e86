// SPDX-License-Identifier: BSD-2-Clause
// These tests check the order of tiles: each comes once, and the tiles so far predict the time of
// the others. Times are invented, so that no clock decides.
#include "core/render/tiles.h"

#include <gtest/gtest.h>

#include <functional>
#include <set>
#include <utility>

namespace exphoton {
namespace {

using Cost = std::function<double(double, double)>;  // of a tile, by its place in [0,1]^2

// Returns the largest factor between the estimated and the true rest of the time, from a tenth to
// nine tenths of the time. The estimate assumes that all pixels take equally long.
double WorstEstimate(const Tiles& tiles, const PixelBounds& crop, const Cost& cost) {
  const auto costOf = [&](std::int64_t number) {
    const PixelBounds tile = tiles.Get(number);
    const double x = (tile.x0 + tile.x1) / 2., y = (tile.y0 + tile.y1) / 2.;
    return cost(x / crop.Width(), y / crop.Height()) * tile.Width() * tile.Height();
  };
  double total = 0, elapsed = 0, pixels = 0, worst = 1;
  for (std::int64_t i = 0; i < tiles.Count(); ++i) total += costOf(i);
  for (std::int64_t i = 0; i < tiles.Count(); ++i) {
    elapsed += costOf(i);
    pixels += double(tiles.Get(i).Width()) * tiles.Get(i).Height();
    if (elapsed < .1 * total || elapsed > .9 * total) continue;
    const double part = pixels / (double(crop.Width()) * crop.Height());
    const double ratio = elapsed * (1 - part) / part / (total - elapsed);
    worst = std::max({worst, ratio, 1 / ratio});
  }
  return worst;
}

TEST(Tiles, AScatteredOrderHasEachTileOnce) {
  for (const auto& [width, height] :
       {std::pair(1, 1), {16, 16}, {33, 1}, {48, 36}, {200, 150}, {512, 384}, {1920, 1080}}) {
    const Tiles tiles({0, 0, width, height}, {});
    std::set<std::pair<int, int>> places;
    for (std::int64_t i = 0; i < tiles.Count(); ++i)
      places.insert({tiles.Get(i).x0, tiles.Get(i).y0});
    EXPECT_EQ(std::int64_t(places.size()), tiles.Count()) << width << " x " << height;
  }
}

TEST(Tiles, TheFirstTenthOfTheTimePredictsTheRestWithinAFactorOfTwo) {
  const Cost costs[] = {
      [](double, double y) { return y < .5 ? 1. : 10; },  // a sky above a room
      [](double, double y) { return y < .5 ? 10. : 1; },  // glass above a floor
      [](double x, double) { return x < .2 ? 20. : 1; },  // a column of glass
      [](double x, double y) { return x + y < .5 ? 9. : 1; },
      [](double, double y) { return 1 + 9 * y; },
  };
  for (const auto& [width, height] : {std::pair(200, 150), {512, 384}, {640, 480}, {1920, 1080}}) {
    const PixelBounds crop{0, 0, width, height};
    for (const Cost& cost : costs)
      EXPECT_LT(WorstEstimate(Tiles(crop, {}), crop, cost), 2) << width << " x " << height;
  }
  // Row by row, the sky would promise too much.
  RenderOptions rows;
  rows.tileOrder = TileOrder::Scanline;
  const PixelBounds crop{0, 0, 512, 384};
  EXPECT_GT(WorstEstimate(Tiles(crop, rows), crop, costs[0]), 4);
}

}  // namespace
}  // namespace exphoton
