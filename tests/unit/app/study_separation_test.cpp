// SPDX-License-Identifier: BSD-2-Clause
// These tests separate the noise and the bias of synthetic pictures with known variance and bias.
#include "core/app/analysis/separation.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/math/sampling/random.h"

namespace exphoton::study {
namespace {

constexpr int kColumns = 160, kRows = 120;

// Returns a normal variate from two uniform variates (Box and Muller).
double Normal(RandomStream* random) {
  const double u = 1 - double(random->Uniform()), v = double(random->Uniform());
  return std::sqrt(-2 * std::log(u)) * std::cos(2 * 3.14159265358979 * v);
}

// Returns a picture whose values are the truth 1 plus the bias plus independent noise.
Image Noisy(double bias, double deviation, std::uint64_t seed) {
  Image image(kColumns, kRows, {"R", "G", "B"});
  RandomStream random(HashKey({seed, 77}));
  for (float& value : image.pixels) value = float(1 + bias + deviation * Normal(&random));
  return image;
}

std::vector<Image> Pictures(int count, double bias, double deviation) {
  std::vector<Image> pictures;
  for (int k = 0; k < count; ++k) pictures.push_back(Noisy(bias, deviation, std::uint64_t(k)));
  return pictures;
}

constexpr double kWeight = 1 / 1.01;  // weight of relMSE at r = 1

TEST(StudySeparation, FindsTheKnownVarianceAndBias) {
  const Reference reference = MakeReference(Noisy(0, 0, 1), Noisy(0, 0, 2));
  const Separation s = Separate(Pictures(4, .1, .2), reference);
  EXPECT_EQ(s.seeds, 4);
  EXPECT_NEAR(s.variance.value, .04 * kWeight, .001);
  EXPECT_NEAR(s.bias2.value, .01 * kWeight, .001);
  EXPECT_NEAR(s.relMse.value, .05 * kWeight, .001);
  EXPECT_LT(std::abs(s.variance.value - .04 * kWeight), 4 * s.variance.error + 1e-4);
  EXPECT_LT(std::abs(s.bias2.value - .01 * kWeight), 4 * s.bias2.error + 1e-4);
}

TEST(StudySeparation, TakesTheReferencesNoiseOff) {
  const Reference reference = MakeReference(Noisy(0, .3, 101), Noisy(0, .3, 102));
  EXPECT_NEAR(reference.variance.value, .045, .01);  // .3^2 / 2, but the weights are noisy
  const Separation s = Separate(Pictures(4, .1, .2), reference);
  EXPECT_NEAR(s.relMse.value, s.error.value + reference.variance.value, 1e-12);
  EXPECT_NEAR(s.error.value, s.variance.value + s.bias2.value, 1e-12);
}

TEST(StudySeparation, OfSmallReferenceNoiseLeavesTheBias) {
  const Reference reference = MakeReference(Noisy(0, .05, 101), Noisy(0, .05, 102));
  EXPECT_NEAR(reference.variance.value, .00125 * kWeight, 2e-5);
  const Separation s = Separate(Pictures(6, .1, .2), reference);
  // The weights come from the noisy reference, too. This adds 4 x bias x its variance / r.
  const double fromWeights = 2 * .1 * 2 * reference.variance.value;
  EXPECT_NEAR(s.bias2.value, .01 * kWeight + fromWeights, 4 * s.bias2.error);
  EXPECT_LT(s.bias2.error, .001);
}

TEST(StudySeparation, WithoutBiasFindsNone) {
  const Reference reference = MakeReference(Noisy(0, .05, 101), Noisy(0, .05, 102));
  const Separation s = Separate(Pictures(6, 0, .2), reference);
  EXPECT_LT(std::abs(s.bias2.value), 4 * s.bias2.error);
}

// All pixels of a picture share this noise, as they share photons. Errors do not average out
// between pixels, and the standard errors must show it.
TEST(StudySeparation, StandardErrorsSeeNoiseThatPixelsShare) {
  std::vector<Image> pictures;
  RandomStream random(HashKey({5, 5}));
  for (int k = 0; k < 8; ++k) pictures.push_back(Noisy(.2 * Normal(&random), 0, 0));
  const Reference reference = MakeReference(Noisy(0, 0, 1), Noisy(0, 0, 2));
  const Separation s = Separate(pictures, reference);
  EXPECT_GT(s.variance.error, .1 * s.variance.value);
  EXPECT_LT(std::abs(s.variance.value - .04 * kWeight), 4 * s.variance.error);
}

// Of one value a picture, normal with variance 1, the estimate of the variance from K pictures has
// the standard deviation sqrt(2 / (K - 1)).
TEST(StudySeparation, TheStandardErrorOfTheVarianceIsItsSpread) {
  constexpr int kRounds = 2000, kSeeds = 8;
  const auto grey = [](double value) {
    Image image(1, 1, {"R", "G", "B"});
    for (float& each : image.pixels) each = float(value);
    return image;
  };
  const Reference reference = MakeReference(grey(1), grey(1));
  RandomStream random(HashKey({6, 6}));
  double squares = 0;
  for (int round = 0; round < kRounds; ++round) {
    std::vector<Image> pictures;
    for (int k = 0; k < kSeeds; ++k) pictures.push_back(grey(1 + Normal(&random)));
    const double error = Separate(pictures, reference).variance.error / kWeight;
    squares += error * error / kRounds;
  }
  // A jackknife errs on the side of too much, here by less than a fifth.
  const double spread = std::sqrt(2. / (kSeeds - 1));
  EXPECT_GT(std::sqrt(squares), .95 * spread);
  EXPECT_LT(std::sqrt(squares), 1.25 * spread);
}

TEST(StudySeparation, OfFewSeedsSaysWhatItCannotKnow) {
  const Reference reference = MakeReference(Noisy(0, 0, 1), Noisy(0, 0, 2));
  const Separation one = Separate(Pictures(1, .1, .2), reference);
  EXPECT_TRUE(one.relMse.IsKnown());
  EXPECT_FALSE(one.variance.IsKnown());
  const Separation two = Separate(Pictures(2, .1, .2), reference);
  EXPECT_NEAR(two.variance.value, .04 * kWeight, .002);
  EXPECT_FALSE(std::isfinite(two.variance.error));
}

TEST(StudySeparation, LeavesNonFinitePixelsOut) {
  std::vector<Image> pictures = Pictures(3, .1, .2);
  pictures[1].At(5, 5, 1) = std::numeric_limits<float>::quiet_NaN();
  pictures[2].At(9, 9, 0) = std::numeric_limits<float>::infinity();
  const Separation s = Separate(pictures, MakeReference(Noisy(0, 0, 1), Noisy(0, 0, 2)));
  EXPECT_NEAR(s.variance.value, .04 * kWeight, .001);
}

TEST(StudySeparation, AReferenceThatIsTooNoisyIsToldByItsShareOfTheError) {
  const Reference reference = MakeReference(Noisy(0, .1, 101), Noisy(0, .1, 102));  // noise .005
  EXPECT_LT(ReferenceShortfall(reference, .1), 1);
  EXPECT_NEAR(ReferenceShortfall(reference, .005), 10, .5);  // ten times the render time is enough
  const Reference unknown = MakeReference(Noisy(0, 0, 1));
  EXPECT_FALSE(unknown.variance.IsKnown());
  EXPECT_EQ(ReferenceShortfall(unknown, 1e-9), 0);
}

TEST(StudySeparation, FindsTheBiasOfBlocksWithoutTheNoise) {
  const Reference reference = MakeReference(Noisy(0, 0, 1), Noisy(0, 0, 2));
  const std::vector<Image> pictures = Pictures(4, .1, .2);
  for (const int width : {1, 16, 1000}) {
    const Measured bias2 = SeparateBlocks(pictures, reference, width);
    EXPECT_LT(std::abs(bias2.value - .01 * kWeight), 4 * bias2.error + 1e-4) << width;
    EXPECT_LT(bias2.error, .001) << width;
  }
  EXPECT_NEAR(SeparateBlocks(pictures, reference, 1).value,
              Separate(pictures, reference).bias2.value, 1e-9);
}

// The blocks at the right and lower edges are smaller than the others.
TEST(StudySeparation, BiasOfBothSignsCancelsInBlocks) {
  std::vector<Image> pictures;
  for (int k = 0; k < 3; ++k) {
    pictures.push_back(Noisy(0, 0, 0));
    for (int y = 0; y < kRows; ++y)
      for (int x = 0; x < kColumns; ++x)
        for (int c = 0; c < 3; ++c) pictures.back().At(x, y, c) += x / 16 % 2 ? -.1f : .1f;
  }
  const Reference reference = MakeReference(Noisy(0, 0, 1), Noisy(0, 0, 2));
  EXPECT_NEAR(SeparateBlocks(pictures, reference, 16).value, .01 * kWeight, 1e-6);
  EXPECT_NEAR(SeparateBlocks(pictures, reference, 32).value, 0, 1e-6);
  // Three blocks in a row have a third of the bias, and the last one is 16 pixels wide.
  const double shares = (3 * 48. / 9 + 16) / 160;
  EXPECT_NEAR(SeparateBlocks(pictures, reference, 48).value, .01 * kWeight * shares, 1e-6);
}

TEST(StudySeparation, TakesTheReferencesNoiseOffTheBiasOfBlocks) {
  const Reference reference = MakeReference(Noisy(0, .05, 101), Noisy(0, .05, 102));
  const Measured bias2 = SeparateBlocks(Pictures(3, 0, 0), reference, 4);
  const double noise = reference.variance.value / 16;  // of the mean of a block
  EXPECT_LT(std::abs(bias2.value), 4 * bias2.error);
  EXPECT_LT(4 * bias2.error, .5 * noise);
}

TEST(StudySeparation, OfFewSeedsDoesNotKnowTheBiasOfBlocks) {
  const Reference reference = MakeReference(Noisy(0, 0, 1), Noisy(0, 0, 2));
  EXPECT_FALSE(SeparateBlocks(Pictures(1, .1, .2), reference, 8).IsKnown());
  const Measured two = SeparateBlocks(Pictures(2, .1, .2), reference, 8);
  EXPECT_NEAR(two.value, .01 * kWeight, .001);
  EXPECT_FALSE(std::isfinite(two.error));
}

TEST(StudySeparation, RefusesPicturesOfOtherSizes) {
  const Reference reference = MakeReference(Noisy(0, 0, 1));
  EXPECT_THROW(Separate({Image(2, 2, {"R", "G", "B"})}, reference), ImageError);
  EXPECT_THROW(MakeReference(Noisy(0, 0, 1), Image(kColumns, kRows, {"Y"})), ImageError);
}

}  // namespace
}  // namespace exphoton::study
