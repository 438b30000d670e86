// SPDX-License-Identifier: BSD-2-Clause
// These tests share the gathers of a wall whose light has known noise, and check the shares of
// fits.
#include "core/render/sharing/windows/sharing_shares.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>

#include "core/math/sampling/random.h"
#include "core/render/sharing/shared_gathers.h"

namespace exphoton {
namespace {

using WallLight = std::function<double(int x, int y)>;
constexpr int kSharedSide = 96, kSharedSamples = 8;
constexpr PixelBounds kSharedWall{0, 0, kSharedSide, kSharedSide};

// Returns gathers with this light, times random factors from 1 - noise to 1 + noise.
GatherFragments WallGathers(const WallLight& light, double noise, std::uint64_t seed = 7) {
  GatherFragments gathers(kSharedWall, kSharedSamples);
  RandomStream random(seed);
  for (int y = 0; y < kSharedSide; ++y)
    for (int x = 0; x < kSharedSide; ++x) {
      for (int i = 0; i < kSharedSamples; ++i) {
        const Point2 at{Real(x) + random.Uniform(), Real(y) + random.Uniform()};
        const double factor = 1 + noise * (2 * double(random.Uniform()) - 1);
        const GatherRecord record{{at.x / 100, at.y / 100, 0},
                                  {0, 0, 1},
                                  {0, 0, 1},
                                  Spectrum(Real(light(x, y) * factor)),
                                  Spectrum(1)};
        gathers.At({x, y}).Add({record}, at, 1, {GatherGroup({x, y}, i), 1});
      }
      gathers.At({x, y}).Finish();
    }
  return gathers;
}

Real ShareAt(const GatherFragments& gathers, Point2i pixel) {
  ThreadPool threads(1);
  const FragmentRows rows(gathers);
  const SharingWindows windows(gathers, rows, &threads);
  const FragmentFits::Source source{gathers, rows, windows};
  const FragmentFits fits(source, kSharedWall, {}, &threads);
  FitNeighbours scratch;
  return SharingShares(source, fits, &threads)
      .At(pixel, FitTarget(gathers.At(pixel).fragments[0]), &scratch);
}

// Returns the mean squared error of the picture.
double ErrorOf(const GatherFragments& gathers, const WallLight& light, bool isShared) {
  Film film(kSharedWall, kSharedWall);
  for (int y = 0; y < kSharedSide; ++y)
    for (int x = 0; x < kSharedSide; ++x)
      for (int i = 0; i < kSharedSamples; ++i) film.AddSample({x, y}, Spectrum(), 1, 1);
  ThreadPool threads(1);
  const SharedLightTarget target{&film, nullptr, nullptr, kSharedWall, kSharedSamples};
  if (isShared)
    SharedGathers(gathers, {kSharedWall}, &threads).AddLight(target);
  else
    AddOwnLight(gathers, target, &threads);
  double sum = 0;
  for (int y = 0; y < kSharedSide; ++y)
    for (int x = 0; x < kSharedSide; ++x) sum += std::pow(film.MeanOf({x, y})[0] - light(x, y), 2);
  return sum / (kSharedSide * kSharedSide);
}

double Even(int, int) { return 1; }
// A pattern of single pixels. No fit resolves it.
double Pattern(int x, int y) { return 1 + .2 * std::cos(2.4 * x + 1.1 * y); }

TEST(SharingShares, AreNearlyOneWithoutBias) {
  double sum = 0;
  int count = 0;
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    const GatherFragments gathers = WallGathers(Even, 1, seed);
    for (int at = 16; at < 80; at += 16, ++count) sum += double(ShareAt(gathers, {at, at}));
  }
  EXPECT_GT(sum / count, .93);
}

// The squared bias is .02 and the variance noise^2 / 24, so the best shares are .51, .10 and .03.
TEST(SharingShares, AreTheRatioOfVarianceAndSquaredDifference) {
  for (const double noise : {.7, .23, .12}) {
    const double variance = noise * noise / (3. * kSharedSamples),
                 best = variance / (variance + .02);
    double sum = 0;
    int count = 0;
    const GatherFragments gathers = WallGathers(Pattern, noise);
    for (int y = 16; y < 80; y += 8)
      for (int x = 16; x < 80; x += 8, ++count) sum += double(ShareAt(gathers, {x, y}));
    EXPECT_NEAR(sum / count, best, .25 * best) << noise;
  }
}

// Own light has the error noise^2 / 24, and the fit more than .018.
TEST(SharingShares, GiveLessErrorThanOwnLightAndThanTheFit) {
  for (const double noise : {.5, .65, .9}) {
    const GatherFragments gathers = WallGathers(Pattern, noise);
    const double shared = ErrorOf(gathers, Pattern, true);
    EXPECT_LT(shared, .85 * ErrorOf(gathers, Pattern, false)) << noise;
    EXPECT_LT(shared, .018) << noise;
  }
}

// A pixel whose windows and shares reach as far as possible, because it lies between grid pixels.
constexpr int kMiddle = 50;
constexpr PixelBounds kPixel{kMiddle, kMiddle, kMiddle + 1, kMiddle + 1};

// The shared light of this pixel and its check.
struct Middle {
  std::array<double, 4> light{};
  std::array<std::array<double, 3>, 2> products{};
  friend bool operator==(const Middle&, const Middle&) = default;
};

// `margin` is the number of pixels around it whose gathers are known.
Middle MiddleOf(const GatherFragments& whole, int margin, const PixelBounds& window) {
  const int first = std::max(kMiddle - margin, 0);
  const int end = std::min(kMiddle + 1 + margin, kSharedSide);
  GatherFragments part({first, first, end, end}, kSharedSamples);
  for (int y = first; y < end; ++y)
    for (int x = first; x < end; ++x) part.At({x, y}) = whole.At({x, y});
  Film film(kSharedWall, kSharedWall);
  film.AddSample({kMiddle, kMiddle}, Spectrum(), 1, 1);
  ThreadPool threads(1);
  const SharedGathers shared(part, {.window = window, .isChecked = true}, &threads);
  const SharingTotals totals = shared.AddLight({&film, nullptr, nullptr, window, kSharedSamples});
  Middle middle{film.MeanOf({kMiddle, kMiddle}), {}};
  for (const CheckedPixel& checked : totals.checked)
    if (checked.pixel.x == kMiddle && checked.pixel.y == kMiddle)
      middle.products = checked.products;
  return middle;
}

TEST(SharingShares, DependOnNoGatherBeyondTheMargin) {
  int beyondWindows = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const GatherFragments whole = WallGathers(
        [](int x, int y) { return 1 + .3 * std::cos(.05 * x * x) * std::sin(.25 * y); }, .3, seed);
    const Middle middle = MiddleOf(whole, kSharedSide, kSharedWall);
    EXPECT_NE(middle.products[0][0], 0);
    EXPECT_TRUE(MiddleOf(whole, SharingMargin(), kPixel) == middle);
    beyondWindows += MiddleOf(whole, SharingWindows::kReach, kPixel) == middle ? 0 : 1;
  }
  EXPECT_GT(beyondWindows, 0) << "the test could not fail";
}

}  // namespace
}  // namespace exphoton
