// SPDX-License-Identifier: BSD-2-Clause
#include "core/app/quote/price_model.h"

#include <gtest/gtest.h>

#include <cmath>

namespace exphoton::cli {
namespace {

std::vector<Pilot> Pilots(double camera, double photonNoise, double slope = 1) {
  std::vector<Pilot> pilots;
  for (double n = 2; n <= 32; n *= 2)
    pilots.push_back({n, camera / std::pow(n, slope) + photonNoise / 2});
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

TEST(PriceModel, SeparatesTheNoiseOfPhotons) {
  PriceModel model;
  model.hasPhotons = true;
  model.FitNoise(Pilots(3, .2));
  EXPECT_NEAR(model.camera, 3, 1e-6);
  EXPECT_NEAR(model.photonNoise, .2, 1e-7);
  // With two pilots, it cannot be separated from scatter.
  model.FitNoise({{2, 1.6}, {4, .85}});
  EXPECT_EQ(model.photonNoise, 0);
}

// .05^2 = .0025 = 1 / 400; seconds are 2 + 3 + 400 / 100.
TEST(PriceModel, OfCameraNoiseAloneIsExact) {
  PriceModel model;
  model.camera = 1, model.fixed = 2, model.maps = 3, model.sample = .01;
  const auto price = PriceOf(model, .05);
  ASSERT_TRUE(price);
  EXPECT_EQ(price->samples, 400);
  EXPECT_EQ(price->photons, 1);
  EXPECT_NEAR(price->seconds, 9, 1e-9);
  EXPECT_LT(price->least, 9);
  EXPECT_GT(price->most, 9);
}

// A bias of 8 % cannot be made up for by samples; four times the photons leave 2 %.
TEST(PriceModel, TakesMorePhotonsForLessBias) {
  PriceModel model;
  model.camera = 1, model.maps = 1, model.sample = .01, model.bias = .08, model.biasUpper = .1;
  model.hasPhotons = true;
  const auto price = PriceOf(model, .05);
  ASSERT_TRUE(price);
  EXPECT_GE(price->photons, 2);
  const double k = price->photons, bias = .08 / k;
  EXPECT_LE(1 / price->samples + bias * bias, .0025);
  EXPECT_FALSE(PriceOf(model, .001));
  model.hasPhotons = false;
  EXPECT_FALSE(PriceOf(model, .05));
}

}  // namespace
}  // namespace exphoton::cli
