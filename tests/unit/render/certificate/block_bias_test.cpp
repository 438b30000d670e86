// SPDX-License-Identifier: BSD-2-Clause
// These tests check the estimate of squared bias and its interval on corrections with known bias
// and noise.
#include "core/render/certificate/block_bias.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "core/math/sampling/random.h"

namespace exphoton {
namespace {

constexpr int kWidth = 64, kHeight = 48;

double Normal(RandomStream* random) {
  const double u = std::max(double(random->Uniform()), 1e-7), v = double(random->Uniform());
  return std::sqrt(-2 * std::log(u)) * std::cos(2 * 3.14159265358979 * v);
}

struct Trial {
  std::function<double(int x, int y)> bias = [](int, int) { return 0.; };
  double noise = 0;   // standard deviation of a pixel's correction
  double rarity = 1;  // share of the pixels that have noise
  double common = 0;  // standard deviation of an error that all pixels of a group share
  std::vector<double> shares = {.5, .5};
};

BlockBias RunTrial(const Trial& trial, int blockWidth, std::uint64_t seed) {
  RandomStream random(HashKey({seed}));
  std::vector<std::vector<float>> pixels;
  for (const double share : trial.shares) {
    std::vector<float>& group = pixels.emplace_back();
    const double scale = 1 / std::sqrt(share * double(trial.shares.size()));
    const double common = trial.common * Normal(&random);
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kWidth; ++x) {
        const bool isNoisy = double(random.Uniform()) < trial.rarity;
        const double noise = isNoisy ? trial.noise / std::sqrt(trial.rarity) : 0;
        const double grey = scale * noise * Normal(&random);
        for (int c = 0; c < 3; ++c)
          group.push_back(
              float(common + grey + .3 * scale * noise * Normal(&random) - trial.bias(x, y)));
      }
  }
  std::vector<BlockBiasEstimator::Group> groups;
  for (std::size_t g = 0; g < pixels.size(); ++g) groups.push_back({pixels[g], trial.shares[g]});
  return BlockBiasEstimator(kWidth, kHeight, groups).Estimate(blockWidth);
}

struct Rates {
  double mean = 0;  // of the estimates
  int covered = 0;  // intervals that hold the truth
  static constexpr int kRuns = 400;
};

Rates RunOften(const Trial& trial, int blockWidth, double truth) {
  Rates rates;
  for (int run = 0; run < Rates::kRuns; ++run) {
    const BlockBias bias = RunTrial(trial, blockWidth, std::uint64_t(run));
    rates.mean += bias.squared / Rates::kRuns;
    if (bias.lower <= truth && truth <= bias.upper) ++rates.covered;
    EXPECT_LE(bias.lower, std::max(bias.squared, 0.));
    EXPECT_GE(bias.upper, bias.squared);
  }
  return rates;
}

double Slope(int x, int) { return .04 * (x + .5) / kWidth - .02; }

// The squared bias of blocks of this width, if the bias is Slope.
double SlopeInBlocks(int blockWidth) {
  double sum = 0;
  for (int x = 0; x < kWidth; ++x) {
    const int first = x / blockWidth * blockWidth;
    const double mean = Slope(first, 0) + .04 * (.5 * (blockWidth - 1)) / kWidth;
    sum += mean * mean / kWidth;
  }
  return sum;
}

// At least 95 % in truth; 400 runs then cover at least 367 with a probability of 99.5 %.
constexpr int kLeastCovered = 367;

TEST(BlockBias, HasNoBiasOfItsOwnAndCoversTheTruth) {
  Trial trial;
  for (const double level : {0., .01, .03}) {
    trial.bias = [level](int, int) { return level; };
    trial.noise = .2;
    for (const int width : {4, 8, 16, 64}) {
      const Rates rates = RunOften(trial, width, level * level);
      EXPECT_NEAR(rates.mean, level * level, 4e-5) << level << " " << width;
      EXPECT_GE(rates.covered, kLeastCovered) << level << " " << width;
    }
  }
}

TEST(BlockBias, SeesBiasThatChangesFromBlockToBlock) {
  Trial trial;
  trial.bias = Slope;
  trial.noise = .1;
  for (const int width : {4, 8, 16, 32}) {
    const double truth = SlopeInBlocks(width);
    const Rates rates = RunOften(trial, width, truth);
    EXPECT_NEAR(rates.mean, truth, 1e-5) << width;
    EXPECT_GE(rates.covered, kLeastCovered) << width;
  }
  EXPECT_LT(SlopeInBlocks(32), .8 * SlopeInBlocks(8));
}

TEST(BlockBias, CoversTheTruthWithRareLargeCorrections) {
  Trial trial;
  trial.bias = [](int, int) { return .02; };
  trial.noise = .5;
  trial.rarity = .02;
  for (const int width : {4, 8}) EXPECT_GE(RunOften(trial, width, 4e-4).covered, kLeastCovered);
}

TEST(BlockBias, CoversTheTruthWithFourUnequalGroups) {
  Trial trial;
  trial.bias = [](int, int) { return .02; };
  trial.noise = .2;
  trial.shares = {.1, .2, .3, .4};
  const Rates rates = RunOften(trial, 16, 4e-4);
  EXPECT_NEAR(rates.mean, 4e-4, 2e-5);
  EXPECT_GE(rates.covered, kLeastCovered);
}

TEST(BlockBias, IsMoreUncertainWithNoiseAndBlocksAreChosenByIt) {
  Trial trial;
  trial.noise = .2;
  const BlockBias little = RunTrial(trial, 8, 1);
  trial.noise = .8;
  const BlockBias much = RunTrial(trial, 8, 1);
  EXPECT_NEAR(much.smallest / little.smallest, 16, 1);
  EXPECT_LT(RunTrial(trial, 32, 1).smallest, much.smallest);
}

// One block without bias is a squared normal number: its upper end is (1 + 1.96)^2 = 8.8 times the
// variance where it has its mean size. The estimate of the variance contains noise that all blocks
// of a group may share, so it is a little larger.
TEST(BlockBias, OneBlockHasTheIntervalOfANormalNumber) {
  Trial trial;
  trial.noise = .2;
  const double variance = .04 * 1.09 / 2 / (kWidth * kHeight);
  double smallest = 0;
  for (std::uint64_t seed = 0; seed < 20; ++seed)
    smallest += RunTrial(trial, 64, seed).smallest / 20;
  EXPECT_GT(smallest / variance, 8.7);
  EXPECT_LT(smallest / variance, 10);
}

TEST(BlockBias, UsesTheFinestBlocksThatCertifyWhatIsWanted) {
  std::vector<float> a(3 * kWidth * kHeight), b(a.size());
  RandomStream random(3);
  for (std::vector<float>* group : {&a, &b})
    for (float& value : *group) value = float(.5 * Normal(&random));
  const std::vector<BlockBiasEstimator::Group> groups{{a, .5}, {b, .5}};
  const BlockBiasEstimator estimator(kWidth, kHeight, groups);
  EXPECT_EQ(estimator.EstimateFor(1).blockWidth, 4);
  const double middle = estimator.Estimate(16).smallest;
  EXPECT_EQ(estimator.EstimateFor(middle).blockWidth, 16);
  EXPECT_EQ(estimator.EstimateFor(0).blockWidth, 64);
  EXPECT_EQ(estimator.EstimateFor(0).blocks, 1);
}

}  // namespace
}  // namespace exphoton
