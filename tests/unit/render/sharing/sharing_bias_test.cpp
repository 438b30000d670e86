// SPDX-License-Identifier: BSD-2-Clause
// These tests check the estimate of the bias of shared gathers against light whose bias is known.
#include "core/render/sharing/sharing_bias.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <vector>

#include "core/math/sampling/random.h"
#include "core/render/sharing/shared_gathers.h"

namespace exphoton {
namespace {

using ValueAt = std::function<double(double x, double y)>;

constexpr int kSize = 96, kSamples = 4, kRuns = 16;

struct Shared {
  SharingBias bias;             // as estimated
  std::vector<double> picture;  // radiance
  std::vector<double> aov;      // the bias of each pixel, as estimated
};

// Returns the result of sharing the gathers of a plane that receives this light. The noise of each
// sample is uniform, and this is its largest relative value. Samples are divided into parts, as at
// edges.
Shared ShareLight(const ValueAt& light, double noise, std::uint64_t seed, int parts = 1) {
  const PixelBounds bounds{0, 0, kSize, kSize};
  GatherFragments gathers(bounds, kSamples);
  Film film(bounds, bounds);
  RandomStream random(seed);
  const Real share = 1 / Real(parts);
  for (int y = 0; y < kSize; ++y) {
    for (int x = 0; x < kSize; ++x) {
      for (int i = 0; i < kSamples * parts; ++i) {
        const Point2 at{Real(x) + random.Uniform(), Real(y) + random.Uniform()};
        const double factor = 1 + noise * (2 * double(random.Uniform()) - 1);
        const GatherRecord record{{at.x / 100, at.y / 100, 0},
                                  {0, 0, 1},
                                  {0, 0, 1},
                                  Spectrum(Real(light(x + .5, y + .5) * factor)),
                                  Spectrum(1)};
        gathers.At({x, y}).Add({record}, at, share, {GatherGroup({x, y}, i), share});
        film.AddSample({x, y}, Spectrum(), 1, share);
      }
      gathers.At({x, y}).Finish();
    }
  }
  ThreadPool threads(1);
  AovFilm aovs(bounds, {Aov::SharingBias});
  const SharedGathers shared(gathers, {bounds}, &threads);
  shared.AddLight({&film, &aovs, nullptr, bounds, kSamples});
  const std::vector<CheckedPixel> checked = shared.Check(bounds, kSamples);
  Shared result{EstimateSharingBias(checked, film).value(), {}, {}};
  Image image;
  aovs.AppendTo(film, false, &image);
  for (std::size_t i = 1; i < image.pixels.size(); i += 3)
    result.aov.push_back(double(image.pixels[i]));
  for (int y = 0; y < kSize; ++y)
    for (int x = 0; x < kSize; ++x) result.picture.push_back(film.MeanOf({x, y})[1]);
  return result;
}

struct Comparison {
  double estimate = 0, standardError = 0;  // mean of the estimates of all runs
  double spread = 0;                       // standard error of this mean, from the runs
  double squaredBias = 0, variance = 0;    // of the pictures, in relMSE; squaredBias without noise
};

Comparison CompareRuns(const ValueAt& light, double noise, int parts = 1) {
  Comparison result;
  double squaredEstimates = 0;
  std::vector<double> sums(std::size_t(kSize * kSize)), squares(sums.size());
  for (int run = 0; run < kRuns; ++run) {
    const Shared shared = ShareLight(light, noise, std::uint64_t(run), parts);
    result.estimate += shared.bias.squared / kRuns;
    squaredEstimates += shared.bias.squared * shared.bias.squared / kRuns;
    result.standardError += shared.bias.standardError * shared.bias.standardError;
    for (std::size_t i = 0; i < sums.size(); ++i) {
      sums[i] += shared.picture[i];
      squares[i] += shared.picture[i] * shared.picture[i];
    }
  }
  result.standardError = std::sqrt(result.standardError) / kRuns;
  result.spread = std::sqrt((squaredEstimates - result.estimate * result.estimate) / (kRuns - 1));
  for (std::size_t i = 0; i < sums.size(); ++i) {
    const double mean = sums[i] / kRuns;
    const double wanted = light(double(i % kSize) + .5, double(i / kSize) + .5);
    const double variance = (squares[i] / kRuns - mean * mean) * kRuns / (kRuns - 1);
    const double scale = 1 / ((wanted * wanted + .01) * double(sums.size()));
    result.squaredBias += ((mean - wanted) * (mean - wanted) - variance / kRuns) * scale;
    result.variance += variance * scale;
  }
  return result;
}

TEST(SharingBias, IsZeroForConstantLight) {
  const Comparison runs = CompareRuns([](double, double) { return 1; }, .9);
  EXPECT_LT(std::abs(runs.estimate), 4 * runs.standardError);
}

// Checks are close to each other, so their errors must not depend on each other much. 16 runs show
// the spread to 18 %.
TEST(SharingBias, HasTheStandardErrorThatRunsShow) {
  for (const double wave : {0., .3}) {
    const Comparison runs =
        CompareRuns([&](double, double y) { return 1 + wave * std::sin(y); }, 1);
    EXPECT_LT(runs.spread, 1.6 * runs.standardError) << wave;
    EXPECT_GT(runs.spread, runs.standardError / 2) << wave;
  }
}

// Sharing flattens light that waves quickly. The noise is so large that it pays all the same.
TEST(SharingBias, IsTheBiasOfThePicturesWhereLightWaves) {
  const Comparison runs = CompareRuns([](double, double y) { return 1 + .3 * std::sin(y); }, 1);
  EXPECT_GT(runs.squaredBias, 8 * runs.standardError) << "the test could not fail";
  EXPECT_NEAR(runs.estimate, runs.squaredBias, .2 * runs.squaredBias + 3 * runs.standardError);
}

// The bias of a column of pixels does not show in the row.
TEST(SharingBias, IsTheBiasOfThePicturesWhereLightWavesAlongRows) {
  const Comparison runs = CompareRuns([](double x, double) { return 1 + .3 * std::sin(x); }, 1);
  EXPECT_GT(runs.squaredBias, 8 * runs.standardError) << "the test could not fail";
  EXPECT_NEAR(runs.estimate, runs.squaredBias, .2 * runs.squaredBias + 3 * runs.standardError);
}

// Dark columns of pixels, 8 pixels apart, show as much wherever they lie.
TEST(SharingBias, IsTheSameForEvenAndOddColumns) {
  const auto runsOf = [](int column) {
    return CompareRuns([&](double x, double) { return int(x) % 8 == column ? .4 : 1.; }, 1);
  };
  const Comparison even = runsOf(2), odd = runsOf(3);
  EXPECT_GT(even.estimate, 8 * even.standardError) << "the test could not fail";
  EXPECT_NEAR(even.estimate, odd.estimate, 3 * std::hypot(even.standardError, odd.standardError));
}

// Four parts have the noise of one sample together.
TEST(SharingBias, CountsPartsOfSamplesAsParts) {
  const Comparison runs = CompareRuns([](double, double y) { return 1 + .3 * std::sin(y); }, 2, 4);
  EXPECT_GT(runs.squaredBias, 8 * runs.standardError) << "the test could not fail";
  EXPECT_NEAR(runs.estimate, runs.squaredBias, .2 * runs.squaredBias + 3 * runs.standardError);
}

// A quarter of the pixels of the crop have gathers, with a relative squared bias of 1 each. The
// pixels beyond the crop, which a filter needs, do not count, and neither does a quarter whose bias
// is not known.
TEST(SharingBias, IsTheMeanOfAllPixelsOfTheCrop) {
  const Film film({0, 0, 96, 96}, {16, 16, 80, 80});
  std::vector<CheckedPixel> checked;
  for (int y = 0; y < 80; y += 2) {
    for (int x = 0; x < 48; x += 2) {
      const int corner = (x / 2 + y / 2) & 1;
      CheckedPixel pixel{{x + corner, y + corner}, {}};
      for (auto& products : pixel.products) products.fill(y < 48 ? .01 : std::nan(""));
      checked.push_back(pixel);
    }
  }
  EXPECT_NEAR(EstimateSharingBias(checked, film).value().squared, 1. / 3, 1e-9);
}

// The light depends on the row only, so a row's mean over pixels and runs has little noise.
TEST(SharingBias, HasItsSignInTheAov) {
  const auto light = [](double, double y) { return 1 + .3 * std::sin(y); };
  std::array<double, kSize> aov{}, bias{};
  for (int run = 0; run < kRuns; ++run) {
    const Shared shared = ShareLight(light, 1, std::uint64_t(run));
    ASSERT_EQ(shared.aov.size(), shared.picture.size());
    for (std::size_t i = 0; i < shared.aov.size(); ++i) {
      const std::size_t y = i / kSize;
      aov[y] += shared.aov[i] / (kSize * kRuns);
      bias[y] += (shared.picture[i] - light(0, double(y) + .5)) / (kSize * kRuns);
    }
  }
  double product = 0, squares = 0;
  for (std::size_t y = 0; y < kSize; ++y) {
    product += aov[y] * bias[y];
    squares += bias[y] * bias[y];
  }
  EXPECT_GT(squares / kSize, .002) << "the test could not fail";
  EXPECT_NEAR(product / squares, 1, .2);
}

}  // namespace
}  // namespace exphoton
