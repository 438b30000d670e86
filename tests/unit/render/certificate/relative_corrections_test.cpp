// SPDX-License-Identifier: BSD-2-Clause
// These tests estimate the levels of the true picture from corrections without noise.
#include "core/render/certificate/relative_corrections.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/render/certificate/corrections.h"

namespace exphoton {
namespace {

constexpr int kSize = 32;

// Returns the true radiance of a picture of radiance 1 that these corrections lead to, by pixel, in
// one channel. The picture is one block. There are two groups without noise.
template <class Correction>
std::vector<double> TrueRadianceOf(const Correction& correction, int width = kSize,
                                   int height = kSize) {
  Corrections corrections({0, 0, width, height}, 1);
  for (int group = 0; group < 2; ++group) {
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x)
        corrections.Add({x, y}, {1, Spectrum(Real(correction(x, y))), 1}, 1);
    corrections.EndPass(group, 1);
  }
  const std::vector<double> picture(std::size_t(3 * width * height), 1);
  const std::vector<double> levels =
      RelativeCorrections(corrections).TrueLevels(picture, std::size_t(std::max(width, height)));
  std::vector<double> radiance;
  for (std::size_t i = 0; i < levels.size(); i += 3) radiance.push_back(std::sqrt(levels[i]));
  return radiance;
}

std::size_t At(int x, int y) { return std::size_t(y * kSize + x); }

// The left half is .4 too bright.
TEST(RelativeCorrections, FindDarkPartsOfABlock) {
  const auto radiance = TrueRadianceOf([](int x, int) { return x < kSize / 2 ? -.4 : 0; });
  EXPECT_NEAR(radiance[At(0, 0)], .6, 1e-6);
  EXPECT_NEAR(radiance[At(15, 31)], .6, 1e-6);
  EXPECT_NEAR(radiance[At(16, 0)], 1, 1e-6);
  EXPECT_NEAR(radiance[At(31, 31)], 1, 1e-6);
}

// The sum of x and y is even at this pixel, so only odd pixels learn from it.
TEST(RelativeCorrections, DoNotChangeTheLevelOfTheirOwnPixel) {
  const auto radiance =
      TrueRadianceOf([](int x, int y) { return x == 5 && y == 3 ? -.25 * 32 : 0; });
  EXPECT_NEAR(radiance[At(5, 3)], 1, 1e-6);
  EXPECT_NEAR(radiance[At(4, 3)], .75, 1e-6);
  EXPECT_NEAR(radiance[At(7, 7)], 1, 1e-6);
  EXPECT_NEAR(radiance[At(8, 3)], 1, 1e-6);
}

// Each of three widths could halve or double the radiance.
TEST(RelativeCorrections, NeverMakeLevelsTiny) {
  for (const double radiance : TrueRadianceOf([](int, int) { return -1; }))
    EXPECT_NEAR(radiance, .25, 1e-6);
  for (const double radiance : TrueRadianceOf([](int, int) { return 100; }))
    EXPECT_NEAR(radiance, 4, 1e-6);
}

// Cells of 8 pixels do not divide a width of 12 or 9. A single pixel has no other ones.
TEST(RelativeCorrections, KnowPicturesOfAllSizes) {
  constexpr int kSizes[][2] = {{12, 12}, {9, 1}, {1, 5}, {4, 4}, {2, 1}};
  for (const auto& [width, height] : kSizes)
    for (const double radiance : TrueRadianceOf([](int, int) { return -.4; }, width, height))
      EXPECT_NEAR(radiance, .6, 1e-6) << width << " x " << height;
  EXPECT_EQ(TrueRadianceOf([](int, int) { return -.4; }, 1, 1), std::vector<double>{1});
}

}  // namespace
}  // namespace exphoton
