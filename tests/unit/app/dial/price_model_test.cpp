// SPDX-License-Identifier: BSD-2-Clause
#include "core/app/quote/price_model.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/test_plugin.h"

namespace exphoton::cli {
namespace {

// Two halves with n / 2 samples each.
std::vector<Pilot> Pilots(double camera, double photonNoise, double slope = 1) {
  std::vector<Pilot> pilots;
  for (double n = 2; n <= 32; n *= 2)
    pilots.push_back({n, .5 * camera / std::pow(n / 2, slope) + photonNoise / 2});
  return pilots;
}

TEST(PriceModel, FindsTheNoiseOfCameraSamples) {
  PriceModel model;
  model.FitNoise(Pilots(3, 0));
  EXPECT_NEAR(model.camera, 3, 1e-9);
  EXPECT_NEAR(model.slope, 1, 1e-9);
  model.FitNoise(Pilots(3, 0, 1.2));
  EXPECT_NEAR(model.slope, 1.2, 1e-9);
  EXPECT_NEAR(model.camera, 3, 1e-9);
}

// The noise of the first samples falls fast, and later noise as 1/n.
TEST(PriceModel, InterpolatesBetweenPilots) {
  PriceModel model;
  model.FitNoise({{2, .8}, {4, .2}, {8, .1}, {16, .05}, {32, .025}});
  EXPECT_NEAR(model.slope, 1, 1e-9);
  EXPECT_NEAR(model.SamplesFor(1.6), 1, 1e-9);
  EXPECT_NEAR(model.SamplesFor(.8), std::sqrt(2.), 1e-9);
  EXPECT_NEAR(model.SamplesFor(.2), 4, 1e-9);
  EXPECT_NEAR(model.SamplesFor(.05), 16, 1e-9);
  EXPECT_NEAR(model.SamplesFor(.0125), 64, 1e-9);
  const PriceModel noisier = model.WithNoise(2, 1);
  EXPECT_NEAR(noisier.SamplesFor(.4), 4, 1e-9);
  EXPECT_NEAR(noisier.SamplesFor(.025), 64, 1e-9);
}

// By chance, a pilot may have less noise than a larger one.
TEST(PriceModel, KnowsThatNoiseFalls) {
  PriceModel model;
  model.FitNoise({{2, .4}, {4, .05}, {8, .1}});
  EXPECT_EQ(model.points.size(), 2u);
  EXPECT_GT(model.SamplesFor(.3), 1);
  EXPECT_LT(model.SamplesFor(.3), 4);
}

// Two uncertain pilots say little about the slope.
TEST(PriceModel, DrawsTheSlopeToTheUsualOne) {
  PriceModel sure, unsure;
  sure.FitNoise({{2, 4, .01}, {4, 1.5, .01}});
  unsure.FitNoise({{2, 4, 1}, {4, 1.5, .5}});
  EXPECT_GT(sure.slope, 1.4);
  EXPECT_GT(unsure.slope, 1.05);
  EXPECT_LT(unsure.slope, 1.15);
  EXPECT_GT(unsure.slopeError, 5 * sure.slopeError);
}

// A guess counts where the bias is not known. It grows as the root of the area of an estimate.
TEST(PriceModel, TakesFewerPhotonsWhereTheBiasAllowsIt) {
  PriceModel model;
  model.camera = .01, model.maps = 1, model.sample = .001, model.hasPhotons = true;
  EXPECT_EQ(PriceOf(model, {.1})->photons, 1);
  model.leastPhotons = 1. / 16;
  model.guessedBias = .04;
  const auto price = PriceOf(model, {.1});
  ASSERT_TRUE(price);
  EXPECT_EQ(price->photons, .25);  // the bias is 8 %, and 11 % with half of these
  EXPECT_EQ(price->samples, 3);    // .01 / (.01 - .0064)
  EXPECT_EQ(PriceOf(model, {.045})->photons, 1);
}

// Four times the photons have half of the guessed bias. Bias that is known falls with the photons.
TEST(PriceModel, TakesMorePhotonsForAGuess) {
  PriceModel model;
  model.camera = .01, model.maps = 1, model.sample = 1, model.hasPhotons = true;
  model.guessedBias = .04;
  const auto price = PriceOf(model, {.04});
  ASSERT_TRUE(price);
  EXPECT_EQ(price->photons, 4);  // the bias is 2 %, and 2.8 % with half of these
  EXPECT_EQ(price->samples, 9);  // .01 / (.0016 - .0004)
  model.bias = .05;
  EXPECT_EQ(PriceOf(model, {.04})->photons, 4);
  model.bias = .2;  // 4 times the photons leave 5 %
  EXPECT_EQ(PriceOf(model, {.04})->photons, 8);
}

// A guess may be wrong by much, so it counts as the error at most, and no further photons follow.
TEST(PriceModel, TakesNoMoreThanFourTimesThePhotonsForAGuess) {
  PriceModel model;
  model.camera = .01, model.maps = .001, model.sample = 1, model.hasPhotons = true;
  model.guessedBias = 10;
  const auto price = PriceOf(model, {.04});
  ASSERT_TRUE(price);
  EXPECT_EQ(price->photons, 4);
  model.maps = 1000;
  EXPECT_EQ(PriceOf(model, {.04})->photons, 2);  // the bias counts as .04 / sqrt(2)
  model.mostForGuess = 1;
  EXPECT_EQ(PriceOf(model, {.04})->photons, 1);
  EXPECT_EQ(PriceOf(model, {.04})->samples, 9);  // the bias counts as .02
  model.hasPhotons = false;
  EXPECT_EQ(PriceOf(model, {.04})->samples, 7);  // .01 / .0016
}

// 134 samples would be enough. A sampler that takes powers of two renders 256.
TEST(PriceModel, HasThePriceOfTheSamplesThatTheSamplerTakes) {
  PriceModel model;
  model.camera = 1.333, model.sample = 1, model.fixed = .5;
  EXPECT_EQ(PriceOf(model, {.1})->samples, 134);
  TestPlugins plugins;
  const auto rounding = plugins.MakeSampler(R"("lowdiscrepancy")");
  const auto price = PriceOf(model, {.error = .1, .sampler = rounding.get()});
  EXPECT_EQ(price->samples, 256);
  EXPECT_EQ(price->seconds, 256.5);
  EXPECT_LE(price->least, price->seconds);
  EXPECT_GE(price->most, price->seconds);
  const auto exact = plugins.MakeSampler(R"("halton")");
  EXPECT_EQ(PriceOf(model, {.error = .1, .sampler = exact.get()})->samples, 134);
}

// Twice the photons need 256 samples instead of 512, which pays only if samples are rounded.
TEST(PriceModel, ChoosesPhotonsForTheSamplesThatTheSamplerTakes) {
  PriceModel model;
  model.camera = 2, model.bias = .07, model.sample = 1, model.maps = 200, model.hasPhotons = true;
  EXPECT_EQ(PriceOf(model, {.1})->photons, 1);
  TestPlugins plugins;
  const auto rounding = plugins.MakeSampler(R"("lowdiscrepancy")");
  EXPECT_EQ(PriceOf(model, {.error = .1, .sampler = rounding.get()})->photons, 2);
}

// A quarter of the photons leaves some maps as they are.
TEST(PriceModel, KeepsSomeMapsWithFewerPhotons) {
  PriceModel model;
  model.maps = 5, model.keptMaps = 1;
  EXPECT_EQ(model.MapsFor(.25), 2);
  EXPECT_EQ(model.MapsFor(1), 5);
  EXPECT_EQ(model.MapsFor(4), 20);
}

// The scene gives the number of direct photons, so they stay as well.
TEST(PriceModel, KeepsDirectPhotonsThatTheSceneGives) {
  PriceModel model;
  model.FitMaps({10, 1, 4}, .25);
  EXPECT_EQ(model.MapsFor(.25), 10);
  EXPECT_EQ(model.MapsFor(.5), 15);
  EXPECT_EQ(model.MapsFor(1), 25);
  model.FitMaps({50, 2, 4}, 2);
  EXPECT_EQ(model.MapsFor(2), 50);
  EXPECT_EQ(model.MapsFor(1), 25);
  EXPECT_EQ(model.MapsFor(.25), 10);
  model.FitMaps({10, 1, 0}, .25);
  EXPECT_EQ(model.MapsFor(1), 37);
}

// .05^2 = .0025 = 1 / 400; seconds are 2 + 3 + 400 / 100.
TEST(PriceModel, OfCameraNoiseAloneIsExact) {
  PriceModel model;
  model.camera = 1, model.fixed = 2, model.maps = 3, model.sample = .01;
  const auto price = PriceOf(model, {.05});
  ASSERT_TRUE(price);
  EXPECT_EQ(price->samples, 400);
  EXPECT_EQ(price->photons, 1);
  EXPECT_NEAR(price->seconds, 9, 1e-9);
  EXPECT_LT(price->least, 9);
  EXPECT_GT(price->most, 9);
}

// Numbers of samples become integers.
TEST(PriceModel, KeepsTheNumberOfSamplesCountable) {
  PriceModel model;
  model.camera = 1e30, model.sample = 1e-9;
  EXPECT_EQ(PriceOf(model, {1e-5})->samples, 0x1p53);
}

// A bias of 8 % cannot be made up for by samples; four times the photons leave 2 %.
TEST(PriceModel, TakesMorePhotonsForLessBias) {
  PriceModel model;
  model.camera = 1, model.maps = 1, model.sample = .01, model.bias = .08, model.biasUpper = .1;
  model.hasPhotons = true;
  const auto price = PriceOf(model, {.05});
  ASSERT_TRUE(price);
  EXPECT_GE(price->photons, 2);
  const double k = price->photons, bias = .08 / k;
  EXPECT_LE(1 / price->samples + bias * bias, .0025);
  EXPECT_FALSE(PriceOf(model, {.001}));
  model.hasPhotons = false;
  EXPECT_FALSE(PriceOf(model, {.05}));
}

// Noise and bias of sharing together are .0025. The bias falls with the samples.
TEST(PriceModel, TakesMoreSamplesForTheBiasOfSharing) {
  PriceModel model;
  model.camera = 1, model.sample = .01;
  for (const bool mayStop : {false, true}) {
    model.sharing = {100, .001};
    const double samples = PriceOf(model, {.05, 1, mayStop}).value().samples;
    EXPECT_NEAR(1 / samples + model.SharingBiasOf(samples), .0025, 1e-5);
    EXPECT_LT(model.SharingBiasOf(samples), .0006);
  }
  EXPECT_EQ(model.SharingBiasOf(100), .001);
}

// A render that may stop sharing leaves some of the squared error for noise. Others have to wait.
TEST(PriceModel, DoesNotWaitForALargeBiasOfSharing) {
  PriceModel model;
  model.camera = 1, model.sample = .01;
  model.sharing = {100, .01};
  EXPECT_NEAR(PriceOf(model, {.05, 1, true}).value().samples, 400 / .3, 1);
  const double samples = PriceOf(model, {.05}).value().samples;
  EXPECT_NEAR(1 / samples + model.SharingBiasOf(samples), .0025, 1e-5);
}

TEST(PriceModel, IntervalsContainTheErrorOfTheBiasOfSharing) {
  PriceModel model;
  model.camera = 1, model.sample = .01;
  model.sharing = {100, .002};
  const Price exact = PriceOf(model, {.05}).value();
  EXPECT_LT(exact.least, .8 * exact.seconds / 1.35);
  model.sharing.error = .0005;
  EXPECT_GT(PriceOf(model, {.05}).value().most, 1.1 * exact.most);
}

// Two groups may have maps of their own, which have half the noise. Where noise falls faster than
// 1/n, two groups of n/2 samples have more noise than one of n.
TEST(PriceModel, KnowsGroupsOfPasses) {
  PriceModel model;
  model.camera = 1, model.slope = 1.5, model.maps = 1, model.sample = .01;
  const auto one = PriceOf(model, {.05}), two = PriceOf(model, {.05, 2});
  ASSERT_TRUE(one && two);
  EXPECT_EQ(one->samples, std::ceil(std::pow(400., 1 / 1.5)));
  EXPECT_EQ(two->samples, std::ceil(std::pow(400. * std::sqrt(2.), 1 / 1.5)));
  EXPECT_NEAR(two->seconds, 1 + .01 * two->samples, 1e-9);
  model.camera = 1e-6, model.photonNoise = .004;
  EXPECT_FALSE(PriceOf(model, {.05}));
  EXPECT_TRUE(PriceOf(model, {.05, 2}));
}

TEST(PriceModel, TakesTheNoiseOfPhotonsFromTheLastPilot) {
  std::vector<Pilot> pilots = Pilots(2, 0, 1.25);
  pilots.front().photonNoise = .2;
  pilots.back().photonNoise = .3;
  PriceModel model;
  model.FitNoise(pilots);
  EXPECT_NEAR(model.slope, 1.25, 1e-6);
  EXPECT_NEAR(model.camera, 2, 1e-6);
  EXPECT_NEAR(model.photonNoise, .3, 1e-6);
}

// Two groups share one set of maps, unless its noise is more than a quarter of the squared error.
TEST(PriceModel, PaysForOneSetOfMapsWhereItsNoiseIsSmall) {
  PriceModel model;
  model.camera = 1e-6, model.maps = 100, model.sample = 1e-3;
  model.photonNoise = .0006;
  const auto one = PriceOf(model, {.05, 2});
  ASSERT_TRUE(one);
  EXPECT_EQ(one->sets, 1);
  EXPECT_NEAR(one->seconds, 100, .1);
  model.photonNoise = .0007;
  const auto two = PriceOf(model, {.05, 2});
  ASSERT_TRUE(two);
  EXPECT_EQ(two->sets, 2);
  EXPECT_NEAR(two->seconds, 200, .1);
}

// Maps that exist are worth more samples.
TEST(PriceModel, TakesMapsThatExist) {
  PriceModel model;
  model.camera = 1, model.maps = 100, model.sample = 1, model.hasPhotons = true;
  model.leastPhotons = .25;
  EXPECT_EQ(PriceOf(model, {.05, 2})->photons, .25);
  model.owned = 1;
  const auto price = PriceOf(model, {.05, 2});
  EXPECT_EQ(price->photons, 1);
  EXPECT_EQ(price->seconds, price->samples);
  model.photonNoise = .001;  // two sets, of which one exists
  const auto two = PriceOf(model, {.05, 2});
  EXPECT_EQ(two->photons, 1);
  EXPECT_NEAR(two->seconds, 100 + two->samples, 1e-9);
}

// Uncertain noise of the pilots makes the interval wider.
TEST(PriceModel, IntervalsContainTheErrorOfThePilots) {
  PriceModel sure, unsure;
  const double last = .5 / std::pow(2, 1.1);  // the usual slope
  sure.FitNoise({{2, .5, 0}, {4, last, 0}});
  unsure.FitNoise({{2, .5, .25}, {4, last, last / 2}});
  sure.sample = unsure.sample = 1;
  const auto a = PriceOf(sure, {.05}), b = PriceOf(unsure, {.05});
  ASSERT_TRUE(a && b);
  EXPECT_EQ(a->seconds, b->seconds);
  EXPECT_NEAR(b->most / a->most, 1 + 1.645 * .5, .01);
  EXPECT_GT(a->least / b->least, 1 + 1.645 * .5);  // the slope is uncertain as well
}

}  // namespace
}  // namespace exphoton::cli
