// SPDX-License-Identifier: BSD-2-Clause
// These tests check the conversion of maps of infinite lights of version 4.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "core/app/import/sky_map.h"

namespace exphoton::cli {
namespace {

TEST(SkyMap, SquareKeepsAreas) {
  EXPECT_NEAR(SquareOfDirection({0, 0, 1})[0], .5, 1e-12);
  EXPECT_NEAR(SquareOfDirection({1, 0, 0})[0], 1, 1e-12);
  EXPECT_NEAR(SquareOfDirection({1, 0, 0})[1], .5, 1e-12);
  EXPECT_NEAR(SquareOfDirection({0, -1, 0})[1], 0, 1e-12);
  // Points that are uniform on the sphere fall evenly into the cells of the square.
  constexpr int kCells = 8, kHeights = 400, kAngles = 400;
  std::array<int, kCells * kCells> counts{};
  for (int i = 0; i < kHeights; ++i)
    for (int j = 0; j < kAngles; ++j) {
      const double z = (i + .5) / kHeights * 2 - 1, phi = (j + .5) / kAngles * 2 * std::numbers::pi;
      const double r = std::sqrt(1 - z * z);
      const auto [u, v] = SquareOfDirection({r * std::cos(phi), r * std::sin(phi), z});
      const int x = std::min(int(u * kCells), kCells - 1);
      const int y = std::min(int(v * kCells), kCells - 1);
      ++counts[std::size_t(y * kCells + x)];
    }
  const double expected = double(kHeights * kAngles) / (kCells * kCells);
  for (const int count : counts) EXPECT_NEAR(count, expected, .05 * expected);
}

TEST(SkyMap, LatitudeMapHasTheUpperHalfAbove) {
  Image square(16, 16, {"R", "G", "B"});
  for (int y = 0; y < 16; ++y)
    for (int x = 0; x < 16; ++x) {
      const double u = std::abs((x + .5) / 8 - 1), v = std::abs((y + .5) / 8 - 1);
      square.At(x, y, 0) = u + v < 1 ? 1 : 0;  // the upper half is the diamond
      square.At(x, y, 1) = x >= 8 ? 1 : 0;     // towards +x
      square.At(x, y, 2) = y >= 8 ? 1 : 0;     // towards +y
    }
  const Image map = LatitudeMapOf(square);
  ASSERT_EQ(map.Width(), 32);
  ASSERT_EQ(map.Height(), 16);
  EXPECT_FLOAT_EQ(map.At(5, 2, 0), 1);
  EXPECT_FLOAT_EQ(map.At(5, 13, 0), 0);
  EXPECT_FLOAT_EQ(map.At(2, 8, 1), 1);   // phi near 0
  EXPECT_FLOAT_EQ(map.At(16, 8, 1), 0);  // phi near 180 degrees
  EXPECT_FLOAT_EQ(map.At(8, 8, 2), 1);   // phi near 90 degrees
  EXPECT_FLOAT_EQ(map.At(24, 8, 2), 0);
}

}  // namespace
}  // namespace exphoton::cli
