// SPDX-License-Identifier: BSD-2-Clause
// These tests split the error of invented pictures whose noise and biases are known.
#include "core/app/budget/error_budget.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/math/sampling/random.h"

namespace exphoton::cli {
namespace {

constexpr int kBudgetWidth = 24, kBudgetHeight = 16;
constexpr std::size_t kBudgetValues = 3 * kBudgetWidth * kBudgetHeight;
constexpr double kCamera = .09, kGather = .16, kPhotons = .04;  // variances
constexpr double kBlurBias = .3, kSharingBias = -.1;
constexpr double kScale = 1.01;  // 1 / the weight of relMSE at the radiance 1

double NormalValue(RandomStream* random) {
  const double u = 1 - double(random->Uniform()), v = double(random->Uniform());
  return std::sqrt(-2 * std::log(u)) * std::cos(2 * 3.14159265358979 * v);
}

PictureValues Noise(double variance, RandomStream* random) {
  PictureValues values(kBudgetValues);
  for (double& value : values) value = std::sqrt(variance) * NormalValue(random);
  return values;
}

PictureValues Sum(PictureValues a, const PictureValues& b) {
  for (std::size_t i = 0; i < a.size(); ++i) a[i] += b[i];
  return a;
}

PictureValues Grey(double value) { return PictureValues(kBudgetValues, value); }

// Returns a bias that is constant, or has both signs in the columns of each block of two pixels.
PictureValues Bias(double value, bool isStriped) {
  PictureValues values = Grey(value);
  for (std::size_t i = 0; i < values.size(); ++i)
    if (isStriped && i / 3 % 2 == 1) values[i] = -value;
  return values;
}

BudgetFrame FrameOfOnes() {
  return {kBudgetWidth,
          std::vector<double>(kBudgetValues, 1.),
          4,
          {ErrorCause::Blur, ErrorCause::Sharing}};
}

// The truth is 1 everywhere.
PictureValues InventedPicture(const PictureValues& ofPhotons, double gather, RandomStream* random) {
  PictureValues picture = Sum(Grey(1 + kBlurBias + kSharingBias), ofPhotons);
  return Sum(Sum(std::move(picture), Noise(kCamera, random)), Noise(gather, random));
}

std::vector<SeedErrors> InventedSeeds(int count, std::uint64_t key, bool isStriped = false) {
  std::vector<SeedErrors> seeds;
  for (int i = 0; i < count; ++i) {
    RandomStream random(HashKey({key, std::uint64_t(i)}));
    const PictureValues photons = Noise(kPhotons, &random);
    SeedErrors seed;
    for (PictureValues& picture : seed.pictures)
      picture = InventedPicture(photons, kGather, &random);
    for (PictureValues& picture : seed.withMoreRays)
      picture = InventedPicture(photons, kGather / 4, &random);
    seed.biases = {Sum(Bias(kBlurBias, false), Noise(.25, &random)),
                   Sum(Bias(kSharingBias, isStriped), Noise(.25, &random))};
    seeds.push_back(std::move(seed));
  }
  return seeds;
}

const ErrorPart& PartOf(const ErrorBudget& budget, ErrorCause cause) {
  for (const ErrorPart& part : budget.parts)
    if (part.cause == cause) return part;
  throw std::runtime_error("the budget has no such part");
}

// Five standard errors, which must be small themselves.
void ExpectNear(const study::Measured& measured, double truth, double mostError, const char* what) {
  EXPECT_LT(measured.error, mostError) << what;
  EXPECT_GT(measured.error, 0) << what;
  EXPECT_NEAR(measured.value, truth, 5 * measured.error) << what;
}

TEST(ErrorBudget, FindsKnownParts) {
  const ErrorBudget budget = MakeBudget(InventedSeeds(12, 1), FrameOfOnes(), 2);
  const double total = kBlurBias + kSharingBias;
  const auto expect = [&](ErrorCause cause, double truth, double mostError) {
    ExpectNear(PartOf(budget, cause).share, truth / kScale, mostError, ErrorCauseName(cause));
  };
  expect(ErrorCause::CameraSampling, kCamera, .01);
  expect(ErrorCause::GatherDirections, kGather, .01);
  expect(ErrorCause::PhotonNoise, kPhotons, .01);
  expect(ErrorCause::Blur, kBlurBias * total, .01);
  expect(ErrorCause::Sharing, kSharingBias * total, .01);
  ExpectNear(budget.noise, (kCamera + kGather + kPhotons) / kScale, .01, "noise");
  ExpectNear(budget.bias, total * total / kScale, .01, "bias");
  ExpectNear(PartOf(budget, ErrorCause::Blur).squared, kBlurBias * kBlurBias / kScale, .01,
             "squared");
  double sum = 0;
  for (const ErrorPart& part : budget.parts) sum += part.share.value;
  EXPECT_NEAR(budget.sum.value, sum, 1e-12);
  EXPECT_EQ(budget.blockWidth, 2);
}

// The noise of the biases is not counted as bias, so the mean over many budgets is the truth.
TEST(ErrorBudget, HasNoBiasOfItsOwnWithThreeSeeds) {
  double mean = 0, squares = 0, meanOfErrors = 0;
  constexpr int kBudgets = 60;
  for (int i = 0; i < kBudgets; ++i) {
    const ErrorBudget budget =
        MakeBudget(InventedSeeds(3, 100 + std::uint64_t(i)), FrameOfOnes(), 1);
    mean += budget.sum.value / kBudgets;
    squares += budget.sum.value * budget.sum.value / kBudgets;
    meanOfErrors += budget.sum.error * budget.sum.error / kBudgets;
  }
  const double total = kBlurBias + kSharingBias;
  const double truth = (kCamera + kGather + kPhotons + total * total) / kScale;
  const double variance = (squares - mean * mean) * kBudgets / (kBudgets - 1);
  EXPECT_NEAR(mean, truth, 4 * std::sqrt(variance / kBudgets));
  // The jackknife states this spread, rather too much than too little.
  EXPECT_GT(meanOfErrors, .6 * variance);
  EXPECT_LT(meanOfErrors, 3 * variance);
}

TEST(ErrorBudget, SeesBiasOfBothSignsInFineBlocksOnly) {
  const std::vector<SeedErrors> seeds = InventedSeeds(12, 2, true);
  const double fine = kBlurBias * kBlurBias + kSharingBias * kSharingBias;
  const double coarse = kBlurBias * kBlurBias;
  ExpectNear(MakeBudget(seeds, FrameOfOnes(), 1).bias, fine / kScale, .01, "pixels");
  ExpectNear(MakeBudget(seeds, FrameOfOnes(), 2).bias, coarse / kScale, .01, "blocks");
}

// Blocks at the right and lower edges have fewer pixels, and count by them.
TEST(ErrorBudget, CountsEveryPixelOnce) {
  std::vector<SeedErrors> seeds = InventedSeeds(3, 3);
  for (SeedErrors& seed : seeds) {
    seed.biases = {Grey(.5), Grey(0)};
    for (std::size_t i = 0; i < kBudgetValues; ++i)
      if (i / 3 % kBudgetWidth >= 20) seed.biases[0][i] = 0;
  }
  for (const int width : {1, 2, 4, 5, 10})
    EXPECT_NEAR(MakeBudget(seeds, FrameOfOnes(), width).bias.value, .25 * 20 / 24 / kScale, 1e-12)
        << width;
}

TEST(ErrorBudget, ChoosesTheFinestBlocksThatAreKnownWell) {
  EXPECT_EQ(MakeBudget(InventedSeeds(12, 4), FrameOfOnes(), 0).blockWidth, 1);
  std::vector<SeedErrors> noisy = InventedSeeds(12, 4);
  RandomStream random(5);
  for (SeedErrors& seed : noisy) seed.biases[0] = Sum(seed.biases[0], Noise(20, &random));
  const ErrorBudget budget = MakeBudget(noisy, FrameOfOnes(), 0);
  EXPECT_GT(budget.blockWidth, 1);
  EXPECT_LT(budget.bias.error, MakeBudget(noisy, FrameOfOnes(), 1).bias.error);
}

TEST(ErrorBudget, HasNoPartForRaysThatAreNotShot) {
  std::vector<SeedErrors> seeds = InventedSeeds(8, 6);
  for (SeedErrors& seed : seeds) seed.withMoreRays = {};
  const ErrorBudget budget = MakeBudget(seeds, FrameOfOnes(), 1);
  EXPECT_EQ(budget.parts.size(), 4u);
  ExpectNear(PartOf(budget, ErrorCause::CameraSampling).share, (kCamera + kGather) / kScale, .01,
             "camera");
}

TEST(ErrorBudget, AgreesWithTheErrorAgainstANoisyReference) {
  const BudgetFrame frame = FrameOfOnes();
  const std::vector<SeedErrors> seeds = InventedSeeds(12, 7);
  std::vector<PictureValues> pictures;
  for (const SeedErrors& seed : seeds) pictures.push_back(seed.pictures[0]);
  RandomStream random(8);
  const std::array<PictureValues, 2> reference{Sum(Grey(1), Noise(.1, &random)),
                                               Sum(Grey(1), Noise(.1, &random))};
  const double total = kBlurBias + kSharingBias;
  const MeasuredError measured = MeasureError(pictures, reference, frame, 1);
  ExpectNear(measured.noise, (kCamera + kGather + kPhotons) / kScale, .01, "noise");
  ExpectNear(measured.bias, total * total / kScale, .01, "bias");
  EXPECT_EQ(measured.insideBlocks.value, 0);
  const MeasuredError inBlocks = MeasureError(pictures, reference, frame, 4);
  ExpectNear(inBlocks.bias, total * total / kScale, .01, "bias of blocks");
  EXPECT_NEAR(inBlocks.insideBlocks.value, measured.bias.value - inBlocks.bias.value, 1e-12);
  ExpectNear(NoiseBetween(pictures, frame), measured.noise.value, .01, "the same noise");
}

TEST(ErrorBudget, HalvesAPartByAFactorOnItsBias) {
  const auto factor = [](double bias, double others) {
    ErrorPart part;
    part.squared.value = bias * bias;
    part.share.value = bias * (bias + others);
    return HalvingFactor(part);
  };
  EXPECT_NEAR(factor(.3, 0), std::sqrt(.5), 1e-12);
  for (const double others : {-.2, .1, 3.}) {
    const double t = factor(.3, others);
    EXPECT_NEAR(t * .3 * (t * .3 + others), .3 * (.3 + others) / 2, 1e-12) << others;
    EXPECT_GT(t, 0);
    EXPECT_LT(t, 1);
  }
  EXPECT_EQ(factor(.3, -.5), 0);  // it reduces the error
}

}  // namespace
}  // namespace exphoton::cli
