// SPDX-License-Identifier: BSD-2-Clause
// These tests bound the light of effects that are left out, for invented pictures.
#include "core/app/dial/omission_bound.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/app/dial/omitted_effect.h"
#include "core/imaging/metrics/noise_test.h"
#include "core/math/sampling/random.h"

namespace exphoton::cli {
namespace {

constexpr int kColumns = 20, kRows = 12;  // with narrow blocks at the edges
using Values = OmissionSample::Values;

Values Constant(double value) { return Values(std::size_t(3 * kColumns * kRows), value); }

// Adds pairs whose light is 1. An effect adds `share` of it in the pixels x < width.
void AddPairs(double share, int width, double noise, std::uint64_t seed, OmissionSample* sample) {
  RandomStream random(HashKey({seed}));
  for (int pair = 0; pair < OmissionSample::kPairs; ++pair) {
    Values without = Constant(1);
    for (std::size_t i = 0; i < without.size(); ++i) {
      const bool isLit = int(i) / 3 % kColumns < width;
      const double error = 1 + noise * (2 * double(random.Uniform()) - 1);
      without[i] -= isLit ? share * error : 0;
    }
    sample->Add(Constant(1), without);
  }
}

TEST(OmissionBound, IsExactWithoutNoise) {
  OmissionSample sample(kColumns, kRows);
  AddPairs(.01, kColumns / 4, 0, 1, &sample);  // a quarter of the pixels
  const auto bound = sample.Bound(1);
  ASSERT_TRUE(bound);
  EXPECT_NEAR(bound->change, .01 / 2 / std::sqrt(1.01), 1e-9);
  EXPECT_NEAR(bound->block, .01 * 5 / 8 / std::sqrt(1.01), 1e-9);  // five of eight columns
  EXPECT_NEAR(sample.MeanShare(), .01 / 4, 1e-12);
}

TEST(OmissionBound, HoldsUnderNoise) {
  constexpr int kTrials = 300;
  int misses = 0;
  double sum = 0;
  for (int trial = 0; trial < kTrials; ++trial) {
    OmissionSample sample(kColumns, kRows);
    AddPairs(.01, 1, 1.5, std::uint64_t(trial), &sample);
    const auto bound = sample.Bound(1);
    ASSERT_TRUE(bound);
    misses += bound->change < .01 / std::sqrt(double(kColumns) * 1.01);
    sum += bound->change;
  }
  EXPECT_LE(misses, 9);  // 3 are expected at most
  EXPECT_LT(sum / kTrials, .01);
}

// All noise is shared by a pair, as the noise of photons is.
TEST(OmissionBound, HoldsWherePairsDiffer) {
  constexpr int kTrials = 300;
  int misses = 0, lowChanges = 0;
  for (int trial = 0; trial < kTrials; ++trial) {
    RandomStream random(HashKey({std::uint64_t(trial)}));
    OmissionSample sample(kColumns, kRows);
    for (int pair = 0; pair < OmissionSample::kPairs; ++pair)
      sample.Add(Constant(1), Constant(1 - .02 * double(random.Uniform())));
    const OmissionBound bound = *sample.Bound(1);
    misses += bound.block < .01 / std::sqrt(1.01);
    lowChanges += bound.change < .01 / std::sqrt(1.01);
  }
  EXPECT_LE(misses, 9);
  EXPECT_LE(lowChanges, 9);
}

TEST(OmissionBound, IsUnknownWithFewPairsOrWithoutAChange) {
  OmissionSample sample(kColumns, kRows);
  for (int pair = 0; pair < OmissionSample::kPairs; ++pair) {
    EXPECT_FALSE(sample.Bound(1)) << pair;
    sample.Add(Constant(1), Constant(1));
  }
  EXPECT_FALSE(sample.Bound(1));
}

TEST(OmissionBound, AddsUpOverEffects) {
  EXPECT_EQ(BoundOf({}), 0);
  EXPECT_DOUBLE_EQ(BoundOf({{"caustics", .001, .2}, {"glossy", .002, .1}}), .003);
  EXPECT_EQ(TextOf(OmittedEffect{"caustics", .0004, .22}),
            "caustics off: at most 0.04 % of the light, would take 22 % of the time");
}

// All bounds hold together at this level.
TEST(OmissionBound, HasALevelOf99Percent) {
  OmissionSample sample(8, 8);
  const double root = std::sqrt(1.01);
  for (int pair = 0; pair < OmissionSample::kPairs; ++pair) {
    const double change = .01 + (pair == 0 ? .004 : -.001);  // mean .01, deviation .005 / sqrt(5)
    sample.Add(Values(192, 1.), Values(192, 1 - change));
  }
  for (const int bounds : {1, 2, 4}) {
    const double t = (sample.Bound(bounds)->block * root - .01) / .001;
    EXPECT_NEAR(StudentTail(t, OmissionSample::kPairs - 1) / 2 * bounds, .01, 1e-6) << t;
  }
}

}  // namespace
}  // namespace exphoton::cli
