// SPDX-License-Identifier: BSD-2-Clause
#include "core/render/passes/accuracy/accuracy_rule.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/math/sampling/random.h"
#include "core/render/passes/pass_sum.h"

namespace exphoton {
namespace {

// Quantiles of the first two looks, whose chances are .05 / 2 and .05 / 6.
constexpr double kFirst = 1.959964, kSecond = 2.393980;

double NormalNumber(RandomStream* random) {
  const double u = std::max(double(random->Uniform()), 1e-9), v = double(random->Uniform());
  return std::sqrt(-2 * std::log(u)) * std::cos(2 * M_PI * v);
}

Certificate Bias(double squared, double lower, double upper) {
  Certificate certificate;
  certificate.bias.squared = squared;
  certificate.bias.lower = lower;
  certificate.bias.upper = upper;
  return certificate;
}

TEST(AccuracyRule, NormalQuantileInvertsTheTail) {
  EXPECT_NEAR(NormalQuantile(.5), 0, 1e-9);
  EXPECT_NEAR(NormalQuantile(.025), kFirst, 1e-6);
  EXPECT_NEAR(NormalQuantile(.05 / 6), kSecond, 1e-6);
  EXPECT_NEAR(NormalQuantile(1e-6), 4.753424, 1e-6);
}

TEST(AccuracyRule, AsksForLessNoiseThanTheAccuracy) {
  AccuracyRule rule(.02, .125);  // relMSE .0004
  EXPECT_FALSE(rule.IsReached());
  rule.Look({.noise = .00035, .noiseError = .00005});
  EXPECT_NEAR(rule.Upper(), .00035 + kFirst * .00005, 1e-9);
  EXPECT_FALSE(rule.IsReached());
  EXPECT_NEAR(rule.Growth(), rule.Upper() / .0004, 1e-9);
  rule.Look({.noise = .00029, .noiseError = .00004});
  EXPECT_NEAR(rule.Upper(), .00029 + kSecond * .00004, 1e-9);
  EXPECT_TRUE(rule.IsReached());
}

TEST(AccuracyRule, CountsTheBiasAndItsInterval) {
  AccuracyRule rule(.02, .125);
  EXPECT_NEAR(rule.NextGoal().smallest, .125 * .0004, 1e-12);
  EXPECT_NEAR(rule.NextGoal().quantile, kFirst, 1e-6);
  const Certificate certificate = Bias(.0001, .00004, .00018);
  rule.Look({.noise = .0002, .noiseError = .00003, .certificate = &certificate});
  const double distance = std::hypot(kFirst * .00003, .00008);
  EXPECT_NEAR(rule.Upper(), .0003 + distance, 1e-9);
  EXPECT_TRUE(rule.IsReached());
  EXPECT_FALSE(rule.IsOutOfReach());
  const double growth = rule.Growth();
  const double later = std::hypot(kFirst * .00003 / growth, .00008 / std::sqrt(growth));
  EXPECT_NEAR(.0002 / growth + .0001 + later, .0004, 1e-9);
  EXPECT_NEAR(rule.NextGoal().quantile, kSecond, 1e-6);
}

// Returns the growth of a picture whose interval of the bias, .0003 wide, needs to be .0001 wide.
double GrowthWithInterval(double smallest, int blockWidth) {
  AccuracyRule rule(.02, .125);  // wants to certify .00005
  Certificate certificate = Bias(.0001, 0, .0001 + .0003);
  certificate.bias.smallest = smallest;
  certificate.bias.blockWidth = blockWidth;
  rule.Look({.noise = .0002, .noiseError = 0, .certificate = &certificate});
  return rule.Growth();
}

// The finest blocks stay, and the noise of their corrections falls as 1 / samples. Without a bias,
// the interval falls like this noise, and otherwise like its root.
TEST(AccuracyRule, ExpectsNarrowerIntervalsOfTheFinestBlocks) {
  const double withBias = GrowthWithInterval(0, 4), without = GrowthWithInterval(.0003, 4);
  EXPECT_NEAR(.0002 / withBias + .0001 + .0003 / std::sqrt(withBias), .0004, 1e-9);
  EXPECT_NEAR((.0002 + .0003) / without + .0001, .0004, 1e-9);
}

// Finer blocks follow, whose interval is no narrower, until there are none.
TEST(AccuracyRule, ExpectsIntervalsToStayWhereFinerBlocksFollow) {
  const double finest = GrowthWithInterval(.00005, 4);
  EXPECT_GT(finest, 1.5);
  EXPECT_LT(finest, 3);
  double before = finest;
  for (const int width : {8, 16, 32, 64}) {
    const double growth = GrowthWithInterval(.00005, width);
    EXPECT_GT(growth, before);
    EXPECT_GT(growth, width / 4);
    EXPECT_LT(growth, 3 * width / 4);
    before = growth;
  }
}

// Before the interval can certify what the accuracy wants, the blocks stay as wide as they are.
TEST(AccuracyRule, ExpectsNarrowerIntervalsUntilTheyCertifyEnough) {
  EXPECT_NEAR(GrowthWithInterval(.0002, 64), GrowthWithInterval(.0002, 4), 1e-9);
  EXPECT_GT(GrowthWithInterval(.00006, 64), 1.5 * GrowthWithInterval(.00006, 4));
}

// A look at another picture takes its part of the 5 %.
TEST(AccuracyRule, CountsLooksThatAreNotUsed) {
  AccuracyRule rule(.02, .125);
  rule.Look({.noise = .0006, .noiseError = .0001});
  EXPECT_NEAR(rule.MostBias({.0002, .0001}), .0002 + kFirst * .0001, 1e-9);
  EXPECT_NEAR(rule.MostBias({-.0002, .0001}), kFirst * .0001, 1e-9);
  EXPECT_NEAR(rule.NextGoal().quantile, kSecond, 1e-6);
  rule.CountLooks(1);
  EXPECT_EQ(rule.Looks(), 2);
  EXPECT_NEAR(rule.NextGoal().quantile, NormalQuantile(.05 / 12), 1e-6);
  EXPECT_NEAR(rule.Upper(), .0006 + kFirst * .0001, 1e-9);
}

// Shared gathers with more samples have less bias, and new photons have less noise.
TEST(AccuracyRule, ExpectsLessBiasOfSharingFromMoreSamples) {
  constexpr double kWanted = .0025;
  AccuracyRule rule(.05, .125);
  Certificate certificate = Bias(.0002, .0002, .0002);
  for (const double squared : {.0016, .004}) {
    certificate.sharing = SharingBias{squared, 0};
    rule.Look({.noise = .0016, .noiseError = 0, .certificate = &certificate});
    const double growth = rule.Growth();
    EXPECT_NEAR(.0016 / growth + squared * std::pow(growth, -.6) + .0002, kWanted, 1e-9);
  }
}

TEST(AccuracyRule, ExpectsLessNoiseFromNewPhotons) {
  for (const double fixed : {.00006, .00012}) {
    AccuracyRule rule(.02, .125);
    rule.Look({.noise = .0006, .noiseError = 0, .fixedNoise = fixed});
    EXPECT_NEAR(rule.Upper(), .0006, 1e-9);
    EXPECT_NEAR(rule.Growth(), fixed < .0001 ? .00054 / .00034 : .0006 / .0004, 1e-6);
  }
}

// 32 samples have 40 times the noise that is allowed, and 30 times if the estimate is one standard
// error too high.
TEST(AccuracyRule, GivesUpAPictureThatIsSureToBeDearerThanItsRival) {
  AccuracyRule rule(.1, .125);
  rule.Look({.noise = .4, .noiseError = .1});
  EXPECT_TRUE(rule.IsDearerThan(.99 * 32 * 29 / 2, 32));
  EXPECT_FALSE(rule.IsDearerThan(1.01 * 32 * 29 / 2, 32));
  EXPECT_FALSE(rule.IsDearerThan(std::numeric_limits<double>::infinity(), 32));
}

// Noise that is hardly known says little.
TEST(AccuracyRule, KeepsAPictureWhoseNoiseIsHardlyKnown) {
  AccuracyRule rule(.1, .125);
  rule.Look({.noise = .4, .noiseError = .395});
  EXPECT_FALSE(rule.IsDearerThan(0, 32));
}

// More photons mend a bias, not another integrator.
TEST(AccuracyRule, KeepsAPictureWhoseBiasIsTooLarge) {
  AccuracyRule rule(.02, .125);
  const Certificate certificate = Bias(.004, .002, .006);
  rule.Look({.noise = .4, .noiseError = 0, .certificate = &certificate});
  EXPECT_TRUE(rule.IsOutOfReach());
  EXPECT_FALSE(rule.IsDearerThan(0, 32));
}

// The light that is missing may have the sign of the bias, so roots of relMSE add up.
TEST(AccuracyRule, AddsWhatIsLeftOut) {
  AccuracyRule rule(.02, .125, .002);
  constexpr double kRoom = .018 * .018, kLevel = 2.053749;  // .04 / 2
  EXPECT_NEAR(rule.NextGoal().smallest, .125 * kRoom, 1e-12);
  EXPECT_NEAR(rule.NextGoal().quantile, kLevel, 1e-6);
  rule.Look({.noise = .0003, .noiseError = .00002});
  const double noise = .0003 + kLevel * .00002;
  EXPECT_NEAR(std::sqrt(rule.Upper()), std::sqrt(noise) + .002, 1e-9);
  EXPECT_FALSE(rule.IsReached());  // .0204
  EXPECT_NEAR(rule.Growth(), noise / kRoom, 1e-6);
  const Certificate certain = Bias(.00039, .00035, .00041);
  rule.Look({.noise = 0, .noiseError = 0, .certificate = &certain});
  EXPECT_TRUE(rule.IsOutOfReach());
}

TEST(AccuracyRule, NoNumberOfSamplesMakesUpForBias) {
  AccuracyRule rule(.02, .125);
  const Certificate probable = Bias(.0005, .0003, .0008), certain = Bias(.0005, .00045, .0006);
  rule.Look({.noise = 0, .noiseError = 0, .certificate = &probable});
  EXPECT_FALSE(rule.IsReached());
  EXPECT_FALSE(rule.IsOutOfReach());
  EXPECT_TRUE(std::isinf(rule.Growth()));
  EXPECT_TRUE(rule.NeedsMorePhotons());
  rule.Look({.noise = 0, .noiseError = 0, .certificate = &certain});
  EXPECT_TRUE(rule.IsOutOfReach());
  const Certificate unknown = Bias(.0005, .00004, .002), small = Bias(.00009, .00008, .0001);
  for (const Certificate& certificate : {unknown, small}) {
    rule.Look({.noise = 0, .noiseError = 0, .certificate = &certificate});
    EXPECT_FALSE(rule.NeedsMorePhotons());
  }
}

TEST(AccuracyRule, AsksForPhotonsOnlyWhereTheyHelp) {
  const Certificate all = Bias(.0003, .0002, .0004), maps = Bias(.00005, .00004, .0001);
  AccuracyRule rule(.02, .125);
  rule.Look({.noise = .0006, .noiseError = 0, .certificate = &all});
  EXPECT_TRUE(rule.NeedsMorePhotons());
  // The bias is the one of shared gathers.
  rule.Look({.noise = .0006, .noiseError = 0, .certificate = &all, .ofMaps = &maps});
  EXPECT_FALSE(rule.NeedsMorePhotons());
  // The bias is noise of the photons that all groups share.
  rule.Look({.noise = .0006, .noiseError = 0, .certificate = &all, .photonNoise = .00025});
  EXPECT_FALSE(rule.NeedsMorePhotons());
  // The picture is nearly done.
  const Certificate sure = Bias(.00015, .00014, .00016);
  rule.Look({.noise = .00025, .noiseError = 0, .certificate = &sure});
  EXPECT_FALSE(rule.NeedsMorePhotons());
}

// The shares of the room are .25 for the bias and .125 for its lower end, and the samples must
// double.
TEST(AccuracyRule, AsksForPhotonsWhereTheBiasIsLargeAndTheEndIsFar) {
  constexpr double kRoom = .02 * .02;
  const auto needsPhotons = [](double bias, double lower, double noise) {
    const Certificate certificate = Bias(bias * kRoom, lower * kRoom, bias * kRoom);
    AccuracyRule rule(.02, .125);
    rule.Look({.noise = noise * kRoom, .noiseError = 0, .certificate = &certificate});
    return rule.NeedsMorePhotons();
  };
  EXPECT_FALSE(needsPhotons(.24, .2, 2));
  EXPECT_TRUE(needsPhotons(.26, .2, 2));
  EXPECT_FALSE(needsPhotons(.5, .12, 2));
  EXPECT_TRUE(needsPhotons(.5, .13, 2));
  EXPECT_FALSE(needsPhotons(.5, .4, .98));
  EXPECT_TRUE(needsPhotons(.5, .4, 1.02));
}

// A picture that is rendered again has looks of its own, but not a chance of 5 % of its own.
TEST(AccuracyRule, CountsLooksAtEarlierRenders) {
  AccuracyRule rule(.02, .125);
  rule.CountLooks(1);
  EXPECT_FALSE(rule.IsReached());
  EXPECT_NEAR(rule.NextGoal().quantile, kSecond, 1e-6);
}

// Two groups show the noise of one pixel with one degree of freedom. As a normal number, its upper
// end would be too low in 46 % of the cases.
TEST(AccuracyRule, CoversTheNoiseOfOnePixel) {
  constexpr int kTrials = 2000;
  constexpr double kDeviation = .01, kNoise = kDeviation * kDeviation / 2 / 1.01;
  constexpr PixelBounds kPixel{0, 0, 1, 1};
  int covered = 0;
  RandomStream random(7);
  for (int trial = 0; trial < kTrials; ++trial) {
    Film picture(kPixel, kPixel);
    PassSum sum(&picture, {{}, 2});
    for (const int group : {0, 1}) {
      Film pass(kPixel, kPixel);
      pass.AddSample({0, 0}, Spectrum(Real(1 + kDeviation * NormalNumber(&random))), 1, 1);
      sum.Add(pass, 1, group);
    }
    AccuracyRule rule(.02, .125);
    rule.Look({.noise = *sum.Noise(),
               .noiseError = sum.NoiseError(),
               .betweenGroups = sum.NoiseBetweenGroups(),
               .freedom = sum.NoiseFreedom()});
    covered += rule.Upper() >= kNoise ? 1 : 0;
  }
  EXPECT_GE(covered, .96 * kTrials);  // the first look may be wrong in 2.5 %
  EXPECT_LE(covered, .99 * kTrials);
}

TEST(AccuracyRule, TakesTheNoiseOfManyCellsAsNearlyNormal) {
  constexpr double kNoise = .0002;
  for (const double freedom : {800., 999., 1001., 1e5}) {
    const double error = kNoise * std::sqrt(2 / (freedom + 2));
    AccuracyRule normal(.02, .125), rule(.02, .125);
    normal.Look({.noise = kNoise, .noiseError = error});
    rule.Look({.noise = kNoise, .noiseError = error, .betweenGroups = kNoise, .freedom = freedom});
    EXPECT_GT(rule.Upper(), normal.Upper());
    EXPECT_LT(rule.Upper(), 1.01 * normal.Upper());
    EXPECT_EQ(rule.Growth(), normal.Growth());
  }
}

// A picture whose error is a little too large should rarely pass, though it is looked at often.
TEST(AccuracyRule, IsRarelyWrongInAnyOfManyLooks) {
  constexpr int kTrials = 20000, kLooks = 20;
  constexpr double kNoise = .000401, kError = .00004;
  int wrong = 0;
  RandomStream random(5);
  for (int trial = 0; trial < kTrials; ++trial) {
    AccuracyRule rule(.02, .125);
    for (int look = 0; look < kLooks && !rule.IsReached(); ++look) {
      rule.Look({.noise = kNoise + kError * NormalNumber(&random), .noiseError = kError});
    }
    wrong += rule.IsReached() ? 1 : 0;
  }
  EXPECT_LT(wrong, .05 * kTrials);
  EXPECT_GT(wrong, .035 * kTrials);  // the rule is not much stricter than it says
}

}  // namespace
}  // namespace exphoton
