// SPDX-License-Identifier: BSD-2-Clause
// These tests filter pictures of which the truth is known.
#include "core/imaging/denoise/denoise.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <random>

namespace exphoton {
namespace {

using Truth = std::function<float(int x, int y, int channel)>;

// Makes a picture with all layers. The halves have independent noise of this standard deviation
// relative to the truth, and the picture is their mean.
Image NoisyPicture(
    int width, int height, const Truth& truth, double noise,
    const Truth& albedo = [](int, int, int) { return .5f; }) {
  Image image(width, height,
              {"R", "G", "B", "A", "half1.R", "half1.G", "half1.B", "half2.R", "half2.G", "half2.B",
               "albedo.R", "albedo.G", "albedo.B", "N.X", "N.Y", "N.Z", "variance.R", "variance.G",
               "variance.B"});
  std::mt19937 random(7);
  const auto uniform = [&] { return double(random()) / 4294967296. - .5; };
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      for (int c = 0; c < 3; ++c) {
        const double exact = double(truth(x, y, c));
        for (const int half : {4, 7})
          image.At(x, y, half + c) = float(exact * (1 + noise * std::sqrt(12.) * uniform()));
        image.At(x, y, c) = (image.At(x, y, 4 + c) + image.At(x, y, 7 + c)) / 2;
        image.At(x, y, 10 + c) = albedo(x, y, c);
      }
      image.At(x, y, 3) = 1;
      image.At(x, y, 15) = 1;
    }
  return image;
}

double RelMse(const Image& image, const Truth& truth) {
  double sum = 0;
  for (int y = 0; y < image.Height(); ++y)
    for (int x = 0; x < image.Width(); ++x)
      for (int c = 0; c < 3; ++c) {
        const double exact = double(truth(x, y, c)), error = double(image.At(x, y, c)) - exact;
        sum += error * error / (exact * exact + .01);
      }
  return sum / (3. * image.Width() * image.Height());
}

DenoiseResult Filtered(const Image& picture, int threads = 1) {
  ThreadPool pool(threads);
  return Denoise(picture, pool);
}

float Ramp(int x, int y, int c) { return .2f + .01f * float(x + y) + .1f * float(c); }
float Step(int x, int, int) { return x < 20 ? .2f : .8f; }

TEST(Denoise, ConstantPictureKeepsItsBits) {
  const auto constant = [](int, int, int c) { return .3f + .1f * float(c); };
  const Image picture = NoisyPicture(24, 20, constant, 0);
  const DenoiseResult result = Filtered(picture);
  for (int y = 0; y < 20; ++y)
    for (int x = 0; x < 24; ++x)
      for (int c = 0; c < 3; ++c) EXPECT_EQ(result.picture.At(x, y, c), picture.At(x, y, c));
  EXPECT_EQ(result.noise, 0);
  EXPECT_EQ(result.residualNoise, 0);
}

TEST(Denoise, PictureWithoutNoiseStaysWithinOneTenThousandth) {
  const auto pattern = [](int x, int y, int c) {
    return .5f + .4f * std::sin(.7f * float(x) + .3f * float(y * y) + float(c));
  };
  const Image picture = NoisyPicture(40, 30, pattern, 0);
  const DenoiseResult result = Filtered(picture);
  for (int y = 0; y < 30; ++y)
    for (int x = 0; x < 40; ++x)
      for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(result.picture.At(x, y, c), picture.At(x, y, c),
                    1e-4 * double(picture.At(x, y, c)));
}

TEST(Denoise, NoiseFalls) {
  const Image picture = NoisyPicture(48, 40, Ramp, .3);
  EXPECT_LT(RelMse(Filtered(picture).picture, Ramp), RelMse(picture, Ramp) / 15);
}

// A flat picture has no bias, so its whole error is the residual noise.
TEST(Denoise, EstimatesTheNoiseBeforeAndAfter) {
  const auto flat = [](int, int, int) { return .6f; };
  const Image picture = NoisyPicture(48, 40, flat, .3);
  const DenoiseResult result = Filtered(picture);
  const double before = RelMse(picture, flat), after = RelMse(result.picture, flat);
  EXPECT_NEAR(result.noise, before, .1 * before);
  EXPECT_GT(result.residualNoise, after / 2);
  EXPECT_LT(result.residualNoise, after * 2);
}

// The colours alone would not separate the two sides: the noise is as large as the step.
TEST(Denoise, LayersKeepAnEdge) {
  const Image guided = NoisyPicture(40, 40, Step, .8, Step), plain = NoisyPicture(40, 40, Step, .8);
  const double withEdge = RelMse(Filtered(guided).picture, Step);
  const double without = RelMse(Filtered(plain).picture, Step);
  EXPECT_LT(withEdge, RelMse(guided, Step) / 20);
  EXPECT_LT(withEdge, without / 2);
}

// Returns the sum of a channel.
double Light(const Image& image, int channel) {
  double sum = 0;
  for (int y = 0; y < image.Height(); ++y)
    for (int x = 0; x < image.Width(); ++x) sum += double(image.At(x, y, channel));
  return sum;
}

void SetHalf(Image* picture, int x, int y, int half, float value) {
  picture->At(x, y, 1 + 3 * half) = value;
  picture->At(x, y, 0) = (picture->At(x, y, 4) + picture->At(x, y, 7)) / 2;
}

TEST(Denoise, DimsAnOutlierAndSaysHowMuchLightItHad) {
  Image picture = NoisyPicture(40, 40, Ramp, .2);
  const double without = Light(picture, 0);
  SetHalf(&picture, 20, 20, 1, 60);
  const DenoiseResult result = Filtered(picture);
  EXPECT_EQ(result.outliers.pixels, 1);
  const double all = Light(picture, 0) + Light(picture, 1) + Light(picture, 2);
  EXPECT_NEAR(result.outliers.light, (60 - 4 * .7) / 2 / all, .1 * 60 / 2 / all);
  EXPECT_NEAR(Light(result.picture, 0), without, .005 * without);
  // Spread over the window, it would add 60 / 2 / 225 to each pixel.
  for (int y = 14; y < 27; ++y)
    for (int x = 14; x < 27; ++x)
      EXPECT_NEAR(result.picture.At(x, y, 0), Ramp(x, y, 0), .05) << x << ", " << y;
}

// Splatted samples give the halves different weights, here 3 to 7 or 7 to 3. The mean of the halves
// is then not the picture: a residue of 200 would stay, or the pixel would be negative.
TEST(Denoise, DimsAnOutlierOfAHalfWithAnotherWeight) {
  for (const float share : {.3f, .7f}) {
    Image picture = NoisyPicture(40, 40, Ramp, .2);
    SetHalf(&picture, 20, 20, 1, 1000);
    picture.At(20, 20, 0) = share * 1000 + (1 - share) * picture.At(20, 20, 7);
    const DenoiseResult result = Filtered(picture);
    EXPECT_EQ(result.outliers.pixels, 1);
    EXPECT_NEAR(result.picture.At(20, 20, 0), Ramp(20, 20, 0), .06) << share;
  }
}

// Both halves have a bright pixel in the window: the light is there, and the filter keeps it.
TEST(Denoise, KeepsTheMeanOfLightThatBothHalvesHaveFound) {
  Image picture = NoisyPicture(40, 40, Ramp, .2);
  SetHalf(&picture, 20, 20, 1, 60);
  SetHalf(&picture, 24, 17, 2, 40);
  const DenoiseResult result = Filtered(picture);
  EXPECT_EQ(result.outliers.pixels, 0);
  EXPECT_LT(result.picture.At(20, 20, 0), 15);
  EXPECT_NEAR(Light(result.picture, 0), Light(picture, 0), .005 * Light(picture, 0));
}

// A lamp has few pixels, so outliers cannot be distinguished from noise.
TEST(Denoise, KeepsTheLightOfASmallLamp) {
  const auto isLamp = [](int x, int y) { return x >= 20 && x < 23 && y >= 10 && y < 14; };
  const auto albedo = [&](int x, int y, int) { return isLamp(x, y) ? 1.f : .5f; };
  const auto light = [&](int x, int y, int) { return isLamp(x, y) ? 8.f : .5f; };
  Image picture = NoisyPicture(40, 40, light, .2, albedo);
  SetHalf(&picture, 21, 11, 1, 60);
  const DenoiseResult result = Filtered(picture);
  EXPECT_EQ(result.outliers.pixels, 0);
  EXPECT_NEAR(Light(result.picture, 0), Light(picture, 0), .005 * Light(picture, 0));
}

// The noise is exponential: most values are small, a few are large. Weights that come from the same
// values would prefer small ones: the picture would lose 1.2 % of its light.
TEST(Denoise, KeepsTheMeanOfSkewedNoise) {
  Image picture = NoisyPicture(64, 48, Ramp, 0);
  std::mt19937 random(3);
  const auto exponential = [&] { return -std::log((double(random()) + .5) / 4294967296.); };
  double before = 0, after = 0;
  for (int y = 0; y < 48; ++y)
    for (int x = 0; x < 64; ++x)
      for (int c = 0; c < 3; ++c) {
        for (const int half : {4, 7})
          picture.At(x, y, half + c) = float(double(Ramp(x, y, c)) * exponential());
        picture.At(x, y, c) = (picture.At(x, y, 4 + c) + picture.At(x, y, 7 + c)) / 2;
        before += double(picture.At(x, y, c));
      }
  const Image filtered = Filtered(picture).picture;
  for (int y = 0; y < 48; ++y)
    for (int x = 0; x < 64; ++x)
      for (int c = 0; c < 3; ++c) after += double(filtered.At(x, y, c));
  EXPECT_NEAR(after, before, .004 * before);
}

// The right side has so much noise that its colours say nothing.
TEST(Denoise, QuietPixelsDoNotTakeOverOutliers) {
  const auto flat = [](int, int, int) { return .5f; };
  Image picture = NoisyPicture(40, 30, flat, .02);
  const Image noisy = NoisyPicture(40, 30, flat, 3);
  for (int y = 0; y < 30; ++y)
    for (int x = 20; x < 40; ++x)
      for (int c = 0; c < 10; ++c) picture.At(x, y, c) = noisy.At(x, y, c);
  const Image filtered = Filtered(picture).picture;
  for (int y = 0; y < 30; ++y)
    for (int x = 0; x < 16; ++x)
      for (int c = 0; c < 3; ++c) EXPECT_NEAR(filtered.At(x, y, c), .5, .02);
}

TEST(Denoise, DoesNotDependOnTheNumberOfThreads) {
  const Image picture = NoisyPicture(37, 53, Ramp, .3, Step);
  const Image one = Filtered(picture, 1).picture, three = Filtered(picture, 3).picture;
  EXPECT_EQ(one.pixels, three.pixels);
}

TEST(Denoise, PixelsThatAreNotFiniteStayAndDisturbNoOthers) {
  Image picture = NoisyPicture(24, 24, Ramp, .2);
  picture.At(5, 6, 0) = std::numeric_limits<float>::quiet_NaN();
  picture.At(9, 9, 8) = std::numeric_limits<float>::infinity();
  const DenoiseResult result = Filtered(picture);
  EXPECT_EQ(result.nonFinite, 2);
  EXPECT_TRUE(std::isnan(result.picture.At(5, 6, 0)));
  EXPECT_EQ(result.picture.At(9, 9, 0), picture.At(9, 9, 0));
  for (int y = 0; y < 24; ++y)
    for (int x = 0; x < 24; ++x)
      if (x != 5 || y != 6) EXPECT_TRUE(std::isfinite(result.picture.At(x, y, 0)));
}

TEST(Denoise, KeepsOtherLayersAndAttributes) {
  Image picture = NoisyPicture(8, 8, Ramp, .2);
  picture.attributes["scene"] = std::string("room");
  const Image result = Filtered(picture).picture;
  EXPECT_EQ(result.channels, (std::vector<std::string>{"R", "G", "B", "A", "albedo.R", "albedo.G",
                                                       "albedo.B", "N.X", "N.Y", "N.Z"}));
  EXPECT_EQ(std::get<std::string>(result.attributes.at("scene")), "room");
  EXPECT_EQ(result.At(3, 3, 3), 1);
}

TEST(Denoise, NamesMissingLayers) {
  EXPECT_EQ(MissingDenoiseLayers(Image(2, 2, {"R", "G", "B"})),
            (std::vector<std::string>{"half1", "half2", "albedo", "N"}));
  EXPECT_TRUE(MissingDenoiseLayers(NoisyPicture(2, 2, Ramp, 0)).empty());
}

}  // namespace
}  // namespace exphoton
