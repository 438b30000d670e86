// SPDX-License-Identifier: BSD-2-Clause
#include "core/imaging/film/local_square.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace exphoton {
namespace {

constexpr std::size_t kColumns = 9, kRows = 7;

struct Picture {
  std::vector<float> means = std::vector<float>(3 * kColumns * kRows, 1);
  std::vector<float> variances = std::vector<float>(3 * kColumns * kRows, 0);

  std::size_t At(std::size_t x, std::size_t y) const { return 3 * (y * kColumns + x); }
  double Square(std::size_t x, std::size_t y) const {
    return SquaredLevels(means, variances, kColumns)[At(x, y)];
  }
  double Level(std::size_t x, std::size_t y) const { return std::sqrt(Square(x, y)); }
};

TEST(SquaredLevels, OfPreciseValuesAreTheirSquares) {
  Picture picture;
  picture.means[picture.At(4, 3)] = 5;
  EXPECT_EQ(picture.Level(4, 3), 5);
  EXPECT_EQ(picture.Level(3, 3), 1);
}

// The square that has no bias for a level with this variance.
double Unbiased(double level, double variance) {
  const double sum = level * level + .01;
  const double share = variance * (3 * level * level - .01) / (sum * sum);
  return level * level + sum * share * (1 + share / 2);
}

// One value of 25 is too bright by three quarters of its standard deviation. The levels of its
// neighbours have this error, and its own level has not.
TEST(SquaredLevels, OfNoisyValuesAreTheMeanOfTheOthersOfTheirKind) {
  Picture picture;
  std::fill(picture.variances.begin(), picture.variances.end(), .04f);
  picture.means[picture.At(4, 3)] = 1.15f;
  EXPECT_NEAR(picture.Square(4, 3), Unbiased(1, .04 / 24), 1e-6);
  EXPECT_NEAR(picture.Square(3, 3), Unbiased(1 + .15 / 24, .04 / 24), 1e-6);
  // At a border there are 15 values.
  picture.means[picture.At(4, 3)] = 1;
  picture.means[picture.At(4, 0)] = 1.15f;
  EXPECT_NEAR(picture.Square(4, 0), Unbiased(1, .04 / 14), 1e-6);
  EXPECT_NEAR(picture.Square(4, 1), Unbiased(1 + .15 / 19, .04 / 19), 1e-6);
  picture.means[picture.At(4, 0)] = 1;
  picture.means[picture.At(8, 3)] = 1.15f;
  EXPECT_NEAR(picture.Square(8, 3), Unbiased(1, .04 / 14), 1e-6);
}

// Where the square is much smaller than the offset, the inverse is too small and stays so.
TEST(SquaredLevels, OfDarkNoiseAreNotReduced) {
  Picture picture;
  std::fill(picture.means.begin(), picture.means.end(), .01f);
  std::fill(picture.variances.begin(), picture.variances.end(), .04f);
  EXPECT_NEAR(picture.Square(4, 3), .0001, 1e-9);
}

// A dark pixel whose noise is small keeps its value beside a bright surface.
TEST(SquaredLevels, IgnoreNeighboursOfAnotherKind) {
  Picture picture;
  for (std::size_t y = 0; y < kRows; ++y)
    for (std::size_t x = 5; x < kColumns; ++x)
      for (std::size_t c = 0; c < 3; ++c) picture.means[picture.At(x, y) + c] = 100;
  std::fill(picture.variances.begin(), picture.variances.end(), .01f);
  EXPECT_NEAR(picture.Square(4, 3), Unbiased(1, .01 / 14), 1e-6);
  EXPECT_NEAR(picture.Square(5, 3), Unbiased(100, .01 / 14), 1e-4);
}

// The values of the kind are 0 and 2, and the noise explains a part of their spread. In 5 x 5
// pixels there are 13 values of 0 and 12 of 2, with the variance 12 * 13 * 4 / (25 * 24) = 1.04.
TEST(SquaredLevels, StayNearTheValueWhereItsKindDiffers) {
  Picture picture;
  std::fill(picture.variances.begin(), picture.variances.end(), .5f);
  for (std::size_t y = 0; y < kRows; ++y)
    for (std::size_t x = 0; x < kColumns; ++x)
      picture.means[picture.At(x, y)] = (x + y) % 2 ? 0 : 2;
  const double own = (1.04 - .5) / 1.04;  // the value itself is 0
  EXPECT_NEAR(picture.Square(4, 3),
              Unbiased((1 - own) * 1, .5 * (own * own + (1 - own) * (1 - own) / 24)), 1e-6);
}

// A lamp that is much smaller than a pixel. Its groups agree that there is light.
TEST(SquaredLevels, OfAConfirmedBrightPixelAreALowerBoundOfItsValue) {
  Picture picture;
  std::fill(picture.variances.begin(), picture.variances.end(), .01f);
  picture.means[picture.At(4, 3)] = 19;
  picture.variances[picture.At(4, 3)] = 49;
  EXPECT_NEAR(picture.Level(4, 3), 19 - 7, 1e-5);
  const std::vector<float> deviations(picture.means.size() / 3, 1.5f);
  EXPECT_NEAR(
      SquaredLevels(picture.means, picture.variances, kColumns, deviations)[picture.At(4, 3)],
      (19 - 1.5 * 7) * (19 - 1.5 * 7), 1e-4);
  // Noise of the others explains the difference.
  for (std::size_t i = 0; i < picture.variances.size(); ++i) picture.variances[i] = 49;
  EXPECT_LT(picture.Level(4, 3), 8);
}

// Light that only one group has seen may be an error.
TEST(SquaredLevels, OfAnUnconfirmedBrightPixelAreThoseOfItsKind) {
  Picture picture;
  std::fill(picture.variances.begin(), picture.variances.end(), .01f);
  picture.means[picture.At(4, 3)] = 20;
  picture.variances[picture.At(4, 3)] = 19 * 19;
  EXPECT_LT(picture.Level(4, 3), 2);
}

TEST(SquaredLevels, OfInfiniteNoiseAreNumbers) {
  Picture picture;
  picture.variances[picture.At(4, 3)] = std::numeric_limits<float>::infinity();
  EXPECT_EQ(picture.Level(4, 3), 1);
  EXPECT_EQ(picture.Level(3, 3), 1);
}

}  // namespace
}  // namespace exphoton
