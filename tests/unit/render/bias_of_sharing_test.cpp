// SPDX-License-Identifier: BSD-2-Clause
// These tests compare the estimated bias of shared gathers with synthetic pictures of known bias.
#include "core/render/passes/unshared/bias_of_sharing.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "core/math/sampling/random.h"

namespace exphoton {
namespace {

constexpr PixelBounds kBounds{0, 0, 64, 48};
constexpr double kMean = .5, kOffset = .01;
// Standard deviations of a sample without and with sharing.
constexpr double kNoise = .12, kSharedNoise = .06;

using BiasAt = std::function<double(int x, int y)>;

// The sum of twelve uniform numbers is nearly normal.
double Normal(RandomStream* random) {
  double sum = -6;
  for (int i = 0; i < 12; ++i) sum += double(random->Uniform());
  return sum;
}

// A number with mean 0 and variance 1 for a pixel of a group. With `dependence`, those of two
// successive groups have this covariance.
double NoiseOf(std::uint64_t seed, int group, Point2i pixel, double dependence) {
  const auto own = [&](int g) {
    RandomStream random(
        HashKey({seed, std::uint64_t(g + 1), std::uint64_t(pixel.x), std::uint64_t(pixel.y)}));
    return Normal(&random);
  };
  if (group % 2 == 0) return own(group);
  return dependence * own(group - 1) + std::sqrt(1 - dependence * dependence) * own(group);
}

struct Pictures {
  PassNoise shared{kBounds, 4}, unshared{kBounds, 4};

  void Add(int group, int samples, const BiasAt& bias, std::uint64_t seed, double dependence = 0) {
    Film with(kBounds, kBounds), without(kBounds, kBounds);
    const double scale = 1 / std::sqrt(double(samples));
    for (int y = 0; y < kBounds.y1; ++y)
      for (int x = 0; x < kBounds.x1; ++x) {
        const double noise = NoiseOf(seed, group, {x, y}, dependence) * scale;
        const double other = NoiseOf(seed + 100000, group, {x, y}, dependence) * scale;
        without.AddSample({x, y}, Spectrum(Real(kMean + kNoise * noise)), 1, Real(samples));
        with.AddSample({x, y}, Spectrum(Real(kMean + bias(x, y) + kSharedNoise * other)), 1,
                       Real(samples));
      }
    shared.Add(group, with, samples);
    unshared.Add(group, without, samples);
  }
};

// The sign changes from pixel to pixel, in a quarter of the picture.
double Alternating(int x, int y) { return x < 32 && y < 24 ? ((x + y) % 2 ? .15 : -.15) : 0; }
constexpr double kAlternating = .15 * .15 / 4 / (kMean * kMean + kOffset);

double None(int, int) { return 0; }

struct Spread {
  double mean = 0, ofStandardErrors = 0;  // the latter: root mean square of deviations
};

Spread Estimate(const std::function<void(std::uint64_t, Pictures*)>& fill, double truth,
                GroupSamples samples) {
  constexpr int kSeeds = 120;
  Spread spread;
  for (int seed = 1; seed <= kSeeds; ++seed) {
    Pictures pictures;
    fill(std::uint64_t(seed), &pictures);
    const auto bias = BiasOfSharing(pictures.shared, pictures.unshared, samples);
    const double deviation = (bias->squared - truth) / bias->standardError;
    spread.mean += bias->squared / kSeeds;
    spread.ofStandardErrors += deviation * deviation / kSeeds;
  }
  spread.ofStandardErrors = std::sqrt(spread.ofStandardErrors);
  return spread;
}

// The levels have noise of the same samples, which standard errors leave out.
void ExpectRightErrors(const Spread& spread) {
  EXPECT_GT(spread.ofStandardErrors, .7);
  EXPECT_LT(spread.ofStandardErrors, 1.35);
}

TEST(BiasOfSharing, IsUnknownWithOneGroup) {
  Pictures pictures;
  pictures.Add(0, 4, None, 1);
  EXPECT_FALSE(BiasOfSharing(pictures.shared, pictures.unshared, GroupSamples::Independent));
}

TEST(BiasOfSharing, SeesASignThatChangesFromPixelToPixel) {
  const auto fill = [](std::uint64_t seed, Pictures* pictures) {
    pictures->Add(0, 4, Alternating, seed);
    pictures->Add(1, 4, Alternating, seed);
  };
  const Spread spread = Estimate(fill, kAlternating, GroupSamples::Independent);
  EXPECT_NEAR(spread.mean / kAlternating, 1, .03);
  ExpectRightErrors(spread);
}

TEST(BiasOfSharing, TakesGroupsOfDifferentSizes) {
  const auto fill = [](std::uint64_t seed, Pictures* pictures) {
    pictures->Add(0, 4, Alternating, seed);
    pictures->Add(2, 2, Alternating, seed);
    pictures->Add(3, 16, Alternating, seed);
  };
  const Spread spread = Estimate(fill, kAlternating, GroupSamples::Independent);
  EXPECT_NEAR(spread.mean / kAlternating, 1, .03);
  ExpectRightErrors(spread);
}

TEST(BiasOfSharing, IsAboutNothingWithoutBias) {
  const auto fill = [](std::uint64_t seed, Pictures* pictures) {
    for (int group = 0; group < 2; ++group) pictures->Add(group, 4, None, seed);
  };
  const Spread spread = Estimate(fill, 0, GroupSamples::Independent);
  EXPECT_NEAR(spread.mean, 0, .02 * kAlternating);
  ExpectRightErrors(spread);
}

// Halves of one sequence whose errors cancel as usual: twice .45 minus 1.
TEST(BiasOfSharing, AddsWhatCancelsInOneSequence) {
  const auto fill = [](std::uint64_t seed, Pictures* pictures) {
    for (int group = 0; group < 2; ++group) pictures->Add(group, 4, Alternating, seed, -.1);
  };
  const double lost =
      .1 * (kNoise * kNoise + kSharedNoise * kSharedNoise) / 4 / (kMean * kMean + kOffset);
  EXPECT_NEAR(Estimate(fill, kAlternating, GroupSamples::OneSequence).mean, kAlternating,
              .15 * lost);
  EXPECT_NEAR(Estimate(fill, kAlternating, GroupSamples::Independent).mean, kAlternating - lost,
              .15 * lost);
}

// Errors that cancel are those of the first and the second half of a sequence.
TEST(BiasOfSharing, DividesTheGroupsInTheMiddle) {
  Pictures pictures;
  for (int group = 0; group < 4; ++group) {
    const double sign = group < 2 ? 1 : -1;
    pictures.Add(
        group, 64, [&](int x, int y) { return sign * Alternating(x, y); }, 1);
  }
  const auto bias = BiasOfSharing(pictures.shared, pictures.unshared, GroupSamples::Independent);
  EXPECT_NEAR(bias->squared / kAlternating, -1, .05);
}

// Sharing makes a dark line of one pixel as bright as its surroundings. Relative to the brighter
// picture, the error would be a third of the true one.
TEST(BiasOfSharing, IsRelativeToThePictureWithoutSharing) {
  Pictures pictures;
  const BiasAt line = [](int x, int) { return x == 20 ? 2 * kMean : 0; };
  for (int group = 0; group < 2; ++group) pictures.Add(group, 64, line, 1);
  const double truth = 4 * kMean * kMean / 64 / (kMean * kMean + kOffset);
  EXPECT_NEAR(
      BiasOfSharing(pictures.shared, pictures.unshared, GroupSamples::Independent)->squared / truth,
      1, .03);
  pictures.shared.UseLevelsOf(&pictures.unshared);
  EXPECT_EQ(pictures.shared.Levels(), pictures.unshared.Levels());
}

}  // namespace
}  // namespace exphoton
