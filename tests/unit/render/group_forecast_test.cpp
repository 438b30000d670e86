// SPDX-License-Identifier: BSD-2-Clause
// These tests check the forecast of samples from passes whose errors fall by a known power.
#include <gtest/gtest.h>

#include <cmath>

#include "core/render/passes/pass_plan.h"

namespace exphoton {
namespace {

constexpr PixelBounds kOnePixel{0, 0, 1, 1};

// Adds passes of 1, 1, 2, 4 ... samples. Each is farther from the mean of the passes before it by
// `ratio` times the distance of the last one.
GroupForecast ForecastOf(double ratio) {
  GroupForecast forecast(kOnePixel, false);
  double mean = 1, distance = .02;
  int samples = 0;
  for (const int size : {1, 1, 2, 4, 8}) {
    const double value = samples == 0 ? mean : mean + distance;
    Film pass(kOnePixel, kOnePixel);
    for (int i = 0; i < size; ++i) pass.AddSample({0, 0}, Spectrum(Real(value)), 1, 1);
    forecast.Add(pass, size);
    if (samples > 0) {
      mean += distance / 2;
      distance *= ratio;
    }
    samples += size;
  }
  return forecast;
}

// Returns the factor on the samples that a sixteenth of the error asks for.
double FactorForASixteenth(const GroupForecast& forecast) {
  return forecast.SamplesFor(1e-8).value() / forecast.SamplesFor(1.6e-7).value();
}

TEST(GroupForecast, FollowsThePowerByWhichTheErrorFalls) {
  // The difference of two passes is squared in the error: half of it is a quarter of the error.
  EXPECT_NEAR(FactorForASixteenth(ForecastOf(.5)), 4, .1);
  EXPECT_NEAR(FactorForASixteenth(ForecastOf(std::sqrt(.5))), 16, .5);
  EXPECT_NEAR(FactorForASixteenth(ForecastOf(std::exp2(-.75))), std::exp2(4 / 1.5), .3);
}

TEST(GroupForecast, KnowsNothingAfterOnePass) {
  GroupForecast forecast(kOnePixel, false);
  Film pass(kOnePixel, kOnePixel);
  pass.AddSample({0, 0}, Spectrum(1), 1, 1);
  forecast.Add(pass, 1);
  EXPECT_EQ(forecast.SamplesFor(.1), std::nullopt);
}

}  // namespace
}  // namespace exphoton
