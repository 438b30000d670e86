// SPDX-License-Identifier: BSD-2-Clause
// These tests compare the light of pilots, whose noise may come from a few bright pixels.
#include "core/app/quote/missing_light.h"

#include <gtest/gtest.h>

#include <vector>

#include "core/math/sampling/random.h"

namespace exphoton::cli {
namespace {

constexpr std::size_t kWidth = 64, kPixels = 64 * 48;

PilotMean FoundLight(const std::string& name, const MeanLight& light) { return {name, light}; }

TEST(MissingLight, NamesTheIntegratorThatFindsMore) {
  const std::vector<PilotMean> means{FoundLight("path", {.5, .01}),
                                     FoundLight("guidedpath", {1, .01}), FoundLight("failed", {})};
  EXPECT_EQ(MissingLight(means[1], means), "");
  EXPECT_NE(MissingLight(means[0], means).find("50 % less light than guidedpath"),
            std::string::npos);
  const std::vector<PilotMean> noisy{FoundLight("path", {.5, .2}),
                                     FoundLight("guidedpath", {1, .1})};
  EXPECT_EQ(MissingLight(noisy[0], noisy), "");  // within four standard errors
  const std::vector<PilotMean> near{FoundLight("path", {.985, 0}),
                                    FoundLight("guidedpath", {1, 0})};
  EXPECT_EQ(MissingLight(near[0], near), "");
}

// A brighter mean may be noise, but one with less noise shows that light is missing.
TEST(MissingLight, IsNotHiddenByABrighterMeanWithMuchNoise) {
  const std::vector<PilotMean> means{FoundLight("path", {.2, .02}),
                                     FoundLight("exphotonmap", {1, .02}),
                                     FoundLight("guidedpath", {1.5, .9, 3})};
  EXPECT_NE(MissingLight(means[0], means).find("80 % less light than exphotonmap"),
            std::string::npos);
  EXPECT_EQ(MissingLight(means[1], means), "");
}

// With few degrees of freedom, a distance of ten standard errors is not improbable.
TEST(MissingLight, NeedsAKnownError) {
  for (const double freedom : {1., 2., 100.}) {
    const std::vector<PilotMean> means{FoundLight("path", {.87, .001, 1000}),
                                       FoundLight("guidedpath", {1, .01, freedom})};
    EXPECT_EQ(MissingLight(means[0], means).empty(), freedom < 3) << freedom;
  }
}

struct Halves {
  std::vector<double> first = std::vector<double>(kPixels), second = first;

  MeanLight Mean() const { return MeanOfHalves(first, second, kWidth); }
};

Halves Noisy(double light, double noise, std::uint64_t seed) {
  RandomStream random(HashKey({seed}));
  Halves halves;
  for (auto* half : {&halves.first, &halves.second})
    for (double& value : *half) value = light * (1 + noise * (2 * double(random.Uniform()) - 1));
  return halves;
}

// Uniform numbers from -a to a have the variance a^2 / 3.
TEST(MeanLight, HasTheStandardErrorOfBothHalves) {
  double squares = 0;
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    const MeanLight light = Noisy(2, .6, seed).Mean();
    EXPECT_NEAR(light.mean, 2, .03);
    EXPECT_GT(light.freedom, 20);
    squares += light.relativeError * light.relativeError / 50;
  }
  const double expected = .36 / 3 / (2. * kPixels);
  EXPECT_NEAR(squares, expected, .15 * expected);
}

// In scenes/veach-mis, a few samples of bright pixels brought 9 % of the light that path found, and
// the other integrators had no price.
TEST(MissingLight, OneBrightSampleIsNotLightThatAllOthersMiss) {
  const Halves plain = Noisy(1, .5, 1);
  Halves bright = Noisy(1, .5, 2);
  bright.first[1234] += .2 * kPixels;
  const std::vector<PilotMean> means{FoundLight("path", bright.Mean()),
                                     FoundLight("guidedpath", plain.Mean())};
  EXPECT_GT(means[0].light.mean, 1.08);
  EXPECT_EQ(MissingLight(means[1], means), "");
  // Light of all pixels is significant.
  const std::vector<PilotMean> others{FoundLight("path", Noisy(1.1, .5, 2).Mean()),
                                      FoundLight("guidedpath", plain.Mean())};
  EXPECT_NE(MissingLight(others[1], others), "");
}

}  // namespace
}  // namespace exphoton::cli
