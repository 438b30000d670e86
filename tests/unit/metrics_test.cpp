// SPDX-License-Identifier: BSD-2-Clause
// Image differences against values found by hand.
#include "core/imaging/metrics.h"

#include <gtest/gtest.h>

#include <limits>

namespace exphoton {
namespace {

Image Constant(int width, int height, float r, float g, float b) {
  Image image(width, height, {"R", "G", "B"});
  for (std::size_t i = 0; i < image.pixels.size(); i += 3)
    image.pixels[i] = r, image.pixels[i + 1] = g, image.pixels[i + 2] = b;
  return image;
}

TEST(Metrics, AreThoseOfAHandMadePair) {
  const Image reference = Constant(2, 1, 1, 2, 0);
  Image image = reference;
  image.At(0, 0, 0) = 1.5f;   // + 0.5 on 1
  image.At(1, 0, 1) = 1;      // - 1 on 2
  image.At(1, 0, 2) = 0.25f;  // + 0.25 on 0
  const ImageDifference d = CompareImages(reference, image);
  EXPECT_DOUBLE_EQ(d.mse, (.25 + 1 + .0625) / 6);
  EXPECT_DOUBLE_EQ(d.relMse, (.25 / 1.01 + 1 / 4.01 + .0625 / .01) / 6);
  EXPECT_DOUBLE_EQ(d.meanError, -.25 / 6);
  EXPECT_DOUBLE_EQ(d.meanReference, 1);
  EXPECT_DOUBLE_EQ(d.relativeMeanError, -.25 / 6);
  EXPECT_EQ(d.nonFinitePixels, 0);
}

TEST(Metrics, LeaveNonFinitePixelsOut) {
  const Image reference = Constant(3, 1, 1, 1, 1);
  Image image = Constant(3, 1, 2, 2, 2);
  image.At(0, 0, 1) = std::numeric_limits<float>::quiet_NaN();
  image.At(2, 0, 2) = std::numeric_limits<float>::infinity();
  const ImageDifference d = CompareImages(reference, image);
  EXPECT_EQ(d.nonFinitePixels, 2);
  EXPECT_DOUBLE_EQ(d.meanError, 1);
}

TEST(Metrics, CompareChannelsByNameAndIgnoreOthers) {
  Image other(1, 1, {"A", "B", "G", "R"});
  other.pixels = {9, 3, 2, 1};
  EXPECT_EQ(CompareImages(Constant(1, 1, 1, 2, 3), other).mse, 0);
}

TEST(Metrics, OfBlackImagesAreZero) {
  const ImageDifference d = CompareImages(Constant(2, 2, 0, 0, 0), Constant(2, 2, 0, 0, 0));
  EXPECT_EQ(d.relativeMeanError, 0);
  EXPECT_EQ(d.relMse, 0);
}

TEST(Metrics, RefuseOtherSizesAndMissingChannels) {
  EXPECT_THROW(CompareImages(Constant(2, 1, 0, 0, 0), Constant(1, 2, 0, 0, 0)), ImageError);
  EXPECT_THROW(CompareImages(Constant(2, 1, 0, 0, 0), Image(2, 1, {"R", "G"})), ImageError);
}

}  // namespace
}  // namespace exphoton
