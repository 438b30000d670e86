// SPDX-License-Identifier: BSD-2-Clause
// These tests check PNG files: sRGB encoding and decoding, exposure, alpha, 16 bits, and bad files.
#include "core/imaging/files/png.h"

#include <gtest/gtest.h>
#include <png.h>

#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <limits>

#include "core/base/error.h"

namespace exphoton {
namespace {

std::string TemporaryPath(const std::string& name) {
  return (std::filesystem::path(testing::TempDir()) / ("exphoton-" + name)).string();
}

double DecodeSrgb(double v) {
  return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
}

TEST(Png, EveryByteComesBack) {
  Image image(256, 1, {"R", "G", "B"});
  for (int x = 0; x < 256; ++x)
    for (int c = 0; c < 3; ++c) image.At(x, 0, c) = float(DecodeSrgb(x / 255.));
  const std::string path = TemporaryPath("bytes.png");
  WritePng(path, image);
  const Image read = ReadImage(path);
  ASSERT_EQ(read.Width(), 256);
  EXPECT_EQ(read.pixels, image.pixels);
}

TEST(Png, ExposureIsInStopsAndOddValuesAreClamped) {
  Image image(4, 1, {"R", "G", "B", "A"});
  image.pixels = {0.25f, 0.1f, 0.3f, 1, 5, -1, std::numeric_limits<float>::quiet_NaN(), 0.5f, 0, 0,
                  0,     2,    1,    1, 1, 0};
  const std::string path = TemporaryPath("exposure.png");
  WritePng(path, image, {1});
  const Image read = ReadPng(path);
  ASSERT_EQ(read.ChannelCount(), 4);
  EXPECT_NEAR(read.At(0, 0, 0), .5, .004);
  EXPECT_NEAR(read.At(0, 0, 1), .2, .003);
  EXPECT_EQ(read.At(1, 0, 0), 1);
  EXPECT_EQ(read.At(1, 0, 1), 0);
  EXPECT_EQ(read.At(1, 0, 2), 0);
  EXPECT_NEAR(read.At(1, 0, 3), .5, .002);
  EXPECT_EQ(read.At(2, 0, 3), 1);
}

// Compositing programs multiply the colours of a PNG by alpha. Without a division, edges would be
// dark.
TEST(Png, HasColoursThatAreNotMultipliedByAlpha) {
  Image image(3, 1, {"R", "G", "B", "A"});
  // A half-covered pixel, one without coverage, and an opaque one.
  image.pixels = {.25f, .1f, .6f, .5f, .25f, .1f, 0, 0, .25f, .1f, 0, 1};
  const std::string path = TemporaryPath("straight.png");
  WritePng(path, image);
  Image read = ReadPng(path);
  EXPECT_TRUE(read.hasStraightAlpha);
  EXPECT_NEAR(read.At(0, 0, 0), .5, .004);
  EXPECT_NEAR(read.At(0, 0, 1), .2, .003);
  EXPECT_EQ(read.At(0, 0, 2), 1);
  for (const int x : {1, 2}) {
    EXPECT_NEAR(read.At(x, 0, 0), .25, .003);
    EXPECT_NEAR(read.At(x, 0, 1), .1, .003);
  }
  WritePng(path, read);
  EXPECT_EQ(ReadPng(path).pixels, read.pixels);
  PremultiplyAlpha(&read);
  EXPECT_FALSE(read.hasStraightAlpha);
  EXPECT_NEAR(read.At(0, 0, 0), .25, .004);
  EXPECT_NEAR(read.At(0, 0, 3), .5, .002);
  EXPECT_EQ(read.At(1, 0, 0), 0);
  EXPECT_NEAR(MeasureToneLoss(image, {}).clipped, 1. / 3, 1e-9);  // .6 / .5 is above 1
}

TEST(Png, GreyBecomesRgb) {
  const std::string path = TemporaryPath("grey.png");
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  png.width = 2, png.height = 1;
  png.format = PNG_FORMAT_GRAY;
  const std::uint8_t bytes[] = {0, 188};
  ASSERT_TRUE(png_image_write_to_file(&png, path.c_str(), 0, bytes, 0, nullptr));
  const Image read = ReadPng(path);
  EXPECT_EQ(read.channels, (std::vector<std::string>{"R", "G", "B"}));
  for (int c = 0; c < 3; ++c) EXPECT_FLOAT_EQ(read.At(1, 0, c), float(DecodeSrgb(188 / 255.)));
}

TEST(Png, SixteenBitsAreFinerThanEight) {
  const std::string path = TemporaryPath("sixteen.png");
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  png.width = 3, png.height = 1;
  png.format = PNG_FORMAT_LINEAR_RGB;  // written as 16-bit
  const std::uint16_t values[] = {6554, 6554, 6554, 32768, 32768, 32768, 65535, 0, 65535};
  ASSERT_TRUE(png_image_write_to_file(&png, path.c_str(), 0, values, 0, nullptr));
  const Image read = ReadPng(path);
  EXPECT_NEAR(read.At(0, 0, 0), .1, 1e-4);
  EXPECT_NEAR(read.At(1, 0, 1), .5, 1e-4);
  EXPECT_EQ(read.At(2, 0, 0), 1);
  EXPECT_EQ(read.At(2, 0, 1), 0);
}

TEST(Png, ColoursOfSixteenBitsDoNotFadeWithAlpha) {
  const std::string path = TemporaryPath("sixteen_alpha.png");
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  png.width = 2, png.height = 1;
  png.format = PNG_FORMAT_LINEAR_RGB_ALPHA;  // colours times alpha
  const std::uint16_t values[] = {8192, 16384, 4096, 16384, 0, 0, 0, 0};
  ASSERT_TRUE(png_image_write_to_file(&png, path.c_str(), 0, values, 0, nullptr));
  const Image read = ReadPng(path);
  ASSERT_EQ(read.ChannelCount(), 4);
  EXPECT_NEAR(read.At(0, 0, 0), .5, 1e-4);
  EXPECT_NEAR(read.At(0, 0, 1), 1, 1e-4);
  EXPECT_NEAR(read.At(0, 0, 2), .25, 1e-4);
  EXPECT_NEAR(read.At(0, 0, 3), .25, 1e-4);
  for (int c = 0; c < 4; ++c) EXPECT_EQ(read.At(1, 0, c), 0);
}

TEST(Png, TruncatedFilesAreErrors) {
  const std::string path = TemporaryPath("good.png");
  Image image(64, 64, {"R", "G", "B"});
  for (std::size_t i = 0; i < image.pixels.size(); ++i)
    image.pixels[i] = float(i * 7919 % 1000) / 1000;
  WritePng(path, image);
  std::ifstream in(path, std::ios::binary);
  const std::string good{std::istreambuf_iterator<char>(in), {}};
  const std::string bad = TemporaryPath("bad.png");
  for (std::size_t i = 0; i < 16; ++i) {
    std::ofstream(bad, std::ios::binary) << good.substr(0, good.size() * i / 16);
    EXPECT_THROW(ReadImage(bad), ImageError) << i;
  }
}

TEST(Png, UnwritableTargetsAreFileErrors) {
  try {
    WritePng(TemporaryPath("missing/a.png"), Image(1, 1, {"R", "G", "B"}));
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.Status(), ExitStatus::File);
  }
}

}  // namespace
}  // namespace exphoton
