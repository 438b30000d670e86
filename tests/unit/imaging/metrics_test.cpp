// SPDX-License-Identifier: BSD-2-Clause
// These tests compare image differences with values computed by hand.
#include "core/imaging/metrics/metrics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/imaging/metrics/flip.h"

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

TEST(Metrics, TrimTheWorstThousandthAndFindThe99thPercentile) {
  const Image reference = Constant(100, 20, 1, 1, 1);
  Image image = reference;
  for (int c = 0; c < 3; ++c) {
    for (int x = 0; x < 19; ++x) image.At(x, 5, c) = 2;  // 19 of 2000 pixels are off by 1
    image.At(50, 7, c) = 11;                             // two fireflies
    image.At(51, 7, c) = 11;
  }
  const ImageDifference d = CompareImages(reference, image);
  EXPECT_NEAR(d.relMse, (19 + 200) / 1.01 / 2000, 1e-12);
  EXPECT_NEAR(d.trimmedRelMse, 19 / 1.01 / 1998, 1e-12);  // the worst .1 % are two pixels
  EXPECT_NEAR(d.p99, 1 / std::sqrt(1.01), 1e-12);         // the 1980th smallest
}

TEST(Metrics, NameTheChannelsThatAreMissingAndThoseThatAreThere) {
  try {
    FindColors(Image(1, 1, {"R", "Z"}), "a.exr");
    FAIL();
  } catch (const ImageError& error) {
    EXPECT_STREQ(error.what(), "a.exr lacks channel G, B (it has R, Z)");
  }
}

TEST(Metrics, ADifferenceImageHoldsSignedRelativeAndSquaredErrors) {
  const Image reference = Constant(2, 1, 1, 2, 0);
  Image image = reference;
  image.At(1, 0, 1) = 1;
  const Image d = DifferenceImage(reference, image);
  EXPECT_FLOAT_EQ(d.At(1, 0, d.FindChannel("G")), -1);
  EXPECT_FLOAT_EQ(d.At(1, 0, d.FindChannel("relative.G")), float(-1 / std::sqrt(4.01)));
  EXPECT_FLOAT_EQ(d.At(1, 0, d.FindChannel("relMSE.Y")), float(1 / 4.01 / 3));
  EXPECT_GT(d.At(1, 0, d.FindChannel("FLIP.Y")), 0);
  EXPECT_EQ(d.At(0, 0, d.FindChannel("R")), 0);
}

TEST(Metrics, SignedErrorIsRedWhereTooBrightAndBlueWhereTooDark) {
  const Image reference = Constant(4, 1, 1, 1, 1);
  Image image = reference;
  for (int c = 0; c < 3; ++c) {
    image.At(1, 0, c) = 3;
    image.At(2, 0, c) = 0;
  }
  image.At(3, 0, 0) = std::numeric_limits<float>::quiet_NaN();
  const Image shown = SignedErrorImage(reference, image, .5);
  for (int c = 0; c < 3; ++c) EXPECT_EQ(shown.At(0, 0, c), 1);
  EXPECT_GT(shown.At(1, 0, 0), shown.At(1, 0, 2) + .5f);
  EXPECT_GT(shown.At(2, 0, 2), shown.At(2, 0, 0) + .5f);
  EXPECT_GT(shown.At(3, 0, 1), shown.At(3, 0, 2) + .5f);
}

TEST(Flip, OfUniformGreysIsTheirLightnessDifferenceRedistributed) {
  // Blurring and edges have no effect on uniform images. The difference |L1 - L2|^0.7 is mapped
  // linearly up to 0.4 of the largest difference, which is 203.3^0.7 (computed by hand) for the
  // Hunt-adjusted primaries green and blue.
  const Image dark = Constant(32, 24, .2f, .2f, .2f), light = Constant(32, 24, .3f, .3f, .3f);
  const auto lightness = [](double y) { return 116 * std::cbrt(y) - 16; };
  const double largest = std::pow(203.30, .7);
  const double expected = std::pow(lightness(.3) - lightness(.2), .7) * .95 / (.4 * largest);
  for (const float v : FlipMapOfDisplayed(dark, light)) EXPECT_NEAR(double(v), expected, 2e-3);
}

TEST(Flip, IsZeroForEqualPicturesAndSymmetric) {
  Image a(40, 30, {"R", "G", "B"}), b = a;
  for (std::size_t i = 0; i < a.pixels.size(); ++i) {
    a.pixels[i] = float(i * 7919 % 101) / 100;
    b.pixels[i] = float(i * 104729 % 97) / 96;
  }
  EXPECT_EQ(FlipError(a, a), 0);
  const std::vector<float> ab = FlipMapOfDisplayed(a, b), ba = FlipMapOfDisplayed(b, a);
  for (std::size_t i = 0; i < ab.size(); ++i) {
    EXPECT_FLOAT_EQ(ab[i], ba[i]);
    EXPECT_LE(ab[i], 1);
  }
}

TEST(Metrics, RefuseOtherSizesAndMissingChannels) {
  EXPECT_THROW(CompareImages(Constant(2, 1, 0, 0, 0), Constant(1, 2, 0, 0, 0)), ImageError);
  EXPECT_THROW(CompareImages(Constant(2, 1, 0, 0, 0), Image(2, 1, {"R", "G"})), ImageError);
}

}  // namespace
}  // namespace exphoton
