// SPDX-License-Identifier: BSD-2-Clause
// These tests share the gathers of a wall that has lines of single pixels.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "core/math/sampling/random.h"
#include "core/render/sharing/shared_gathers.h"

namespace exphoton {
namespace {

constexpr int kWallSide = 40, kWallSamples = 8;
constexpr PixelBounds kWall{0, 0, kWallSide, kWallSide};

// Returns the shared light of a wall. Gathers have this light, times a random factor with mean 1.
Film ShareWall(const std::function<double(int x)>& lightAt,
               const std::function<double(RandomStream*)>& factor) {
  GatherFragments gathers(kWall, kWallSamples);
  Film film(kWall, kWall);
  RandomStream random(5);
  for (int y = 0; y < kWallSide; ++y)
    for (int x = 0; x < kWallSide; ++x) {
      for (int i = 0; i < kWallSamples; ++i) {
        const Point2 at{Real(x) + random.Uniform(), Real(y) + random.Uniform()};
        const Spectrum light(Real(lightAt(x) * factor(&random)));
        const GatherRecord record{
            {at.x / 100, at.y / 100, 0}, {0, 0, 1}, {0, 0, 1}, light, Spectrum(1)};
        gathers.At({x, y}).Add({record}, at, 1, {GatherGroup({x, y}, i), 1});
        film.AddSample({x, y}, Spectrum(), 1, 1);
      }
      gathers.At({x, y}).Finish();
    }
  ThreadPool threads(1);
  SharedGathers(gathers, {kWall}, &threads)
      .AddLight({&film, nullptr, nullptr, kWall, kWallSamples, nullptr, nullptr});
  return film;
}

double MeanOfColumn(const Film& film, int x) {
  double sum = 0;
  for (int y = 0; y < kWallSide; ++y) sum += film.MeanOf({x, y})[0];
  return sum / kWallSide;
}

double Mild(RandomStream* random) { return .85 + .3 * double(random->Uniform()); }

// Windows are chosen at every fourth pixel, so each place of a line is another case.
TEST(SharedDetails, AreDarkLinesOfOnePixel) {
  for (int line = 20; line < 24; ++line) {
    const Film film = ShareWall([&](int x) { return x == line ? .4 : 1; }, Mild);
    EXPECT_NEAR(MeanOfColumn(film, line), .4, .04) << line;
    EXPECT_NEAR(MeanOfColumn(film, line + 8), 1, .02) << line;
  }
}

TEST(SharedDetails, AreBrightLinesOfOnePixel) {
  for (int line = 20; line < 24; ++line) {
    const Film film = ShareWall([&](int x) { return x == line ? 2.5 : 1; }, Mild);
    EXPECT_NEAR(MeanOfColumn(film, line), 2.5, .25) << line;
  }
}

// One gather in 400 has a hundred times the light of the others.
TEST(SharedDetails, AreNotFireflies) {
  const Film film =
      ShareWall([](int) { return 1; },
                [](RandomStream* random) { return random->Uniform() < Real(1. / 400) ? 80. : .8; });
  double most = 0;
  for (int y = 0; y < kWallSide; ++y)
    for (int x = 0; x < kWallSide; ++x) most = std::max(most, film.MeanOf({x, y})[0]);
  EXPECT_LT(most, 8);  // the own light of a pixel with one is 10.7
}

}  // namespace
}  // namespace exphoton
