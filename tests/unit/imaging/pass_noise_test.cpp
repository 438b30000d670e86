// SPDX-License-Identifier: BSD-2-Clause
// These tests compare the noise between passes with synthetic passes of known variance.
#include "core/imaging/film/pass_noise.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/math/sampling/random.h"

namespace exphoton {
namespace {

constexpr PixelBounds kBounds{0, 0, 64, 48};
constexpr double kMean = .5, kOffset = .01;

// Returns a pass with `samples` per pixel. Each sample has uniform noise of standard deviation
// `noise`. The pass has a common error of deviation `common` in blotches of 4 x 4 pixels.
Film MakePass(std::uint64_t seed, int samples, double noise, double common) {
  Film film(kBounds, kBounds);
  const auto uniform = [](RandomStream& random) {
    return (double(random.Uniform()) - .5) * std::sqrt(12.);
  };
  for (int y = 0; y < kBounds.y1; ++y) {
    for (int x = 0; x < kBounds.x1; ++x) {
      RandomStream blotch(HashKey({seed, 7, std::uint64_t(x / 4), std::uint64_t(y / 4)}));
      RandomStream own(HashKey({seed, 8, std::uint64_t(x), std::uint64_t(y)}));
      const double shared = common * uniform(blotch);
      for (int i = 0; i < samples; ++i)
        film.AddSample({x, y}, Spectrum(Real(kMean + shared + noise * uniform(own))), 1, 1);
    }
  }
  return film;
}

TEST(PassNoise, IsUnknownWithOnePass) {
  PassNoise noise(kBounds, 4);
  EXPECT_TRUE(std::isinf(noise.RelativeVariance()));
  noise.Add(0, MakePass(1, 1, .1, 0), 1);
  noise.Add(0, MakePass(2, 1, .1, 0), 1);
  EXPECT_TRUE(std::isinf(noise.RelativeVariance()));
}

TEST(PassNoise, OfEqualPassesIsNothing) {
  PassNoise noise(kBounds, 4);
  for (int i = 0; i < 3; ++i) noise.Add(i, MakePass(1, 2, .1, 0), 2);
  EXPECT_NEAR(noise.RelativeVariance(), 0, 1e-12);
}

TEST(PassNoise, IsTheVarianceOfTheMeanOfAllPasses) {
  for (const int passes : {2, 4, 11}) {
    PassNoise noise(kBounds, 8);
    for (int i = 0; i < passes; ++i) {
      noise.Add(i % 8, MakePass(std::uint64_t(i), 1, .1, .05), 1);
    }
    const double variance = (.1 * .1 + .05 * .05) / passes;
    // There are 192 blotches, so even two passes give the variance to 8 % or better.
    EXPECT_NEAR(noise.RelativeVariance() * (kMean * kMean + kOffset) / variance, 1, .15) << passes;
  }
}

TEST(PassNoise, CountsGroupsOfUnequalSizeRightly) {
  PassNoise noise(kBounds, 3);
  int total = 0;
  for (const int samples : {1, 2, 5}) {
    noise.Add(total == 0   ? 0
              : total == 1 ? 1
                           : 2,
              MakePass(std::uint64_t(samples), samples, .2, 0), samples);
    total += samples;
  }
  EXPECT_NEAR(noise.RelativeVariance() * (kMean * kMean + kOffset) * total / (.2 * .2), 1, .05);
  EXPECT_NEAR(double(noise.Variances()[0] + noise.Variances()[3]) / 2 * total / (.2 * .2), 1, .95);
}

// A pixel at a light's edge is lit in only one of two passes. Divided by the pixel's square, its
// error would count as 1. Divided by the other pass's square, it would count as a million.
TEST(PassNoise, DoesNotDivergeWhereOnePassMeetsALight) {
  PassNoise noise(kBounds, 2);
  for (int pass = 0; pass < 2; ++pass) {
    Film film = MakePass(std::uint64_t(pass), 1, 0, 0);
    if (pass == 1) film.AddSample({5, 5}, Spectrum(1000), 1, 1);
    noise.Add(pass, film, 1);
  }
  const double estimate = noise.RelativeVariance() * kBounds.x1 * kBounds.y1;
  EXPECT_GT(estimate, 1);
  EXPECT_LT(estimate, 2000);
}

// Few bright hits make pixels too bright, and their halves differ more. Relative to levels that
// contain the pixel itself, this noise would be .77 of the truth.
TEST(PassNoise, DoesNotHideTheNoiseOfPixelsThatAreTooBright) {
  constexpr double kHits = 1, kBrightness = .2;  // of each pixel and pass; the mean is twice this
  constexpr int kTrials = 60;
  const auto pass = [](std::uint64_t seed) {
    Film film(kBounds, kBounds);
    RandomStream random(HashKey({seed, 11}));
    for (int y = 0; y < kBounds.y1; ++y)
      for (int x = 0; x < kBounds.x1; ++x) {
        double light = 0;  // a Poisson number of hits, which are squares of exponential variates
        for (double time = -std::log1p(-double(random.Uniform())); time < kHits;
             time -= std::log1p(-double(random.Uniform())))
          light += kBrightness * std::pow(std::log1p(-double(random.Uniform())), 2);
        film.AddSample({x, y}, Spectrum(Real(light)), 1, 1);
      }
    return film;
  };
  const double mean = kHits * 2 * kBrightness, variance = kHits * 24 * kBrightness * kBrightness;
  double sum = 0;
  for (std::uint64_t trial = 0; trial < kTrials; ++trial) {
    PassNoise noise(kBounds, 2);
    for (int i = 0; i < 2; ++i) noise.Add(i, pass(2 * trial + std::uint64_t(i)), 1);
    sum += noise.RelativeVariance();
  }
  EXPECT_NEAR(sum / kTrials * 2 * (mean * mean + kOffset) / variance, 1.06, .1);
}

// Every fourth column is dark and has noise. Relative to the mean of its neighbourhood, this noise
// would be 12 times too small, as at edges of reflections in scenes/glossy-floor-room.
TEST(PassNoise, CountsTheNoiseOfDarkPixelsBesideBrightOnes) {
  constexpr double kDark = .1, kNoise = .05;
  PassNoise noise(kBounds, 2);
  for (std::uint64_t pass = 0; pass < 2; ++pass) {
    Film film(kBounds, kBounds);
    RandomStream random(HashKey({pass, 5}));
    for (int y = 0; y < kBounds.y1; ++y)
      for (int x = 0; x < kBounds.x1; ++x) {
        const double error = kNoise * (double(random.Uniform()) - .5) * std::sqrt(12.);
        const double light = x % 4 == 0 ? kDark + error : .6;
        film.AddSample({x, y}, Spectrum(Real(light)), 1, 1);
      }
    noise.Add(int(pass), film, 1);
  }
  const double truth = .25 * kNoise * kNoise / 2 / (kDark * kDark + kOffset);
  EXPECT_GT(noise.RelativeVariance(), .5 * truth);
  EXPECT_LT(noise.RelativeVariance(), 1.3 * truth);
}

// The edge of a patch of sun crosses the pixels of one column, and each of their samples is lit or
// dark. A mean over neighbouring pixels mixes the light of the patch into the darker ones, and
// would find half of this noise.
TEST(PassNoise, IsRightAtTheEdgeOfBrightLight) {
  constexpr double kSun = 20, kShadow = .05;
  constexpr int kSamples = 128, kTrials = 40;
  const auto share = [](int y) { return .1 + .8 * (y + .5) / kBounds.y1; };
  const auto pass = [&](std::uint64_t seed) {
    Film film(kBounds, kBounds);
    for (int y = 0; y < kBounds.y1; ++y) {
      for (int x = 0; x < kBounds.x1; ++x) {
        RandomStream random(HashKey({seed, 9, std::uint64_t(x), std::uint64_t(y)}));
        double light = x < 32 ? kSun : kShadow;
        for (int i = 0, lit = 0; x == 32 && i < kSamples; ++i) {
          lit += random.Uniform() < share(y) ? 1 : 0;
          light = kShadow + (kSun - kShadow) * lit / kSamples;
        }
        film.AddSample({x, y}, Spectrum(Real(light)), 1, kSamples);
      }
    }
    return film;
  };
  double expected = 0;
  for (int y = 0; y < kBounds.y1; ++y) {
    const double lit = share(y), mean = lit * kSun + (1 - lit) * kShadow;
    const double variance = lit * (1 - lit) * (kSun - kShadow) * (kSun - kShadow);
    expected += variance / (2 * kSamples * (mean * mean + kOffset));
  }
  double sum = 0;
  for (int trial = 0; trial < kTrials; ++trial) {
    PassNoise noise(kBounds, 2);
    for (int i = 0; i < 2; ++i) noise.Add(i, pass(std::uint64_t(2 * trial + i)), kSamples);
    sum += noise.RelativeVariance() * kBounds.x1 * kBounds.y1;
  }
  EXPECT_NEAR(sum / kTrials / expected, 1, .35);
}

// The error of the estimate is compared with the spread of many estimates. With `common` errors,
// neighbouring pixels agree.
void ExpectErrorOfEstimate(double own, double common, int groups) {
  constexpr int kTrials = 60;
  double sum = 0, squares = 0, predicted = 0;
  for (int trial = 0; trial < kTrials; ++trial) {
    PassNoise noise(kBounds, groups);
    for (int i = 0; i < groups; ++i)
      noise.Add(i, MakePass(std::uint64_t(1000 * trial + i), 1, own, common), 1);
    const double variance = noise.RelativeVariance();
    sum += variance, squares += variance * variance;
    predicted += noise.RelativeVarianceError() * noise.RelativeVarianceError();
  }
  const double mean = sum / kTrials, spread = std::sqrt(squares / kTrials - mean * mean);
  const double error = std::sqrt(predicted / kTrials);
  // 60 trials give the spread to 9 %.
  EXPECT_GT(error, .7 * spread) << own << ' ' << common << ' ' << groups;
  EXPECT_LT(error, 1.6 * spread) << own << ' ' << common << ' ' << groups;
}

TEST(PassNoise, KnowsTheErrorOfItsEstimate) {
  for (const int groups : {2, 4}) {
    ExpectErrorOfEstimate(.1, 0, groups);
    ExpectErrorOfEstimate(.02, .1, groups);
  }
}

// Groups with these samples per pixel in one cell of pixels.
double FreedomOfOneCell(const std::vector<int>& samples) {
  constexpr PixelBounds kCell{0, 0, 8, 8};
  PassNoise noise(kCell, int(samples.size()));
  for (int group = 0; group < int(samples.size()); ++group) {
    Film film(kCell, kCell);
    for (int y = 0; y < kCell.y1; ++y)
      for (int x = 0; x < kCell.x1; ++x)
        for (int i = 0; i < samples[std::size_t(group)]; ++i)
          film.AddSample({x, y}, Spectrum(Real(kMean + .01 * group * group)), 1, 1);
    noise.Add(group, film, samples[std::size_t(group)]);
  }
  return noise.RelativeVarianceFreedom();
}

TEST(PassNoise, OfOneCellHasTheFreedomOfItsGroups) {
  EXPECT_NEAR(FreedomOfOneCell({1, 1}), 1, 1e-6);
  EXPECT_NEAR(FreedomOfOneCell({1, 1, 1, 1}), 3, 1e-6);
  EXPECT_NEAR(FreedomOfOneCell({1, 3}), 1, 1e-6);  // two groups have one difference
  EXPECT_NEAR(FreedomOfOneCell({1, 1, 2}), 1.8, 1e-6);
}

TEST(PassNoise, OfManyCellsHasTheFreedomOfItsError) {
  PassNoise noise(kBounds, 4);
  for (int i = 0; i < 4; ++i) noise.Add(i, MakePass(std::uint64_t(i), 1, .1, 0), 1);
  const double ratio = noise.RelativeVariance() / noise.RelativeVarianceError();
  EXPECT_NEAR(noise.RelativeVarianceFreedom() / (2 * ratio * ratio - 2), 1, 1e-6);
  EXPECT_GT(noise.RelativeVarianceFreedom(), 48 * 3);  // of the cells
}

TEST(PassNoise, IsUncertainIfOnePixelDecides) {
  PassNoise noise(kBounds, 2);
  for (int i = 0; i < 2; ++i) {
    Film film = MakePass(std::uint64_t(i), 1, .01, 0);
    if (i == 0) film.AddSample({20, 20}, Spectrum(Real(1000)), 1, 1);
    noise.Add(i, film, 1);
  }
  EXPECT_GT(noise.RelativeVarianceError(), .5 * noise.RelativeVariance());
}

// Returns a pass with bright light in half of the samples of one pixel, or without.
Film MakeLamp(std::uint64_t seed, int samples, bool isSeen) {
  Film film = MakePass(seed, samples, .01, 0);
  for (int i = 0; i < samples; ++i) film.AddSample({30, 20}, Spectrum(isSeen ? 200 : 1), 1, 1);
  return film;
}

// Returns the level of the lamp after three groups, the first of which has half of the samples.
double LevelOfLamp(bool isInFirst, bool isInSecond) {
  PassNoise noise(kBounds, 3);
  noise.Add(0, MakeLamp(1, 8, isInFirst), 8);
  noise.Add(1, MakeLamp(2, 4, isInSecond), 4);
  noise.Add(2, MakeLamp(3, 4, false), 4);
  return std::sqrt(noise.Levels()[3 * (20 * 64 + 30)]);
}

// Filters with negative lobes add samples of neighbours, so groups of equal size have different
// weights in a pixel.
TEST(PassNoise, DoesNotBelieveLightOfOneGroupWithALargeWeight) {
  PassNoise noise(kBounds, 2);
  Film seen = MakeLamp(1, 8, true);
  for (int i = 0; i < 8; ++i) seen.AddSample({30, 20}, Spectrum(1), 1, Real(.5));
  noise.Add(0, seen, 8);
  noise.Add(1, MakeLamp(2, 8, false), 8);
  EXPECT_LT(std::sqrt(noise.Levels()[3 * (20 * 64 + 30)]), 3);
}

TEST(PassNoise, BelievesBrightLightThatTwoGroupsHaveSeen) {
  EXPECT_GT(LevelOfLamp(true, true), 20);
  EXPECT_LT(LevelOfLamp(true, false), 3);
  EXPECT_LT(LevelOfLamp(false, true), 3);
}

}  // namespace
}  // namespace exphoton
