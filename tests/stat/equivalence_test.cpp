// SPDX-License-Identifier: BSD-2-Clause
// These tests check the rule for means over seeds on numbers with a known distribution.
#include "tests/support/equivalence.h"

#include <gtest/gtest.h>

#include <random>

namespace exphoton {
namespace {

constexpr int kRuns = 20000;

// Returns the fraction of runs that miss the tolerance. Each run has the means of 8 seeds, which
// are normal about `offset` with standard deviation 1.
double ShareThatFails(double offset, double tolerance) {
  std::mt19937 engine(1);
  std::normal_distribution<double> normal(offset, 1);
  int failed = 0;
  for (int i = 0; i < kRuns; ++i) {
    std::vector<double> means(8);
    for (double& mean : means) mean = normal(engine);
    failed += !IsWithinAbsolute(tolerance, EstimateFrom(means), 0);
  }
  return double(failed) / kRuns;
}

// The tolerance is five standard errors of a fraction: a false alarm in two million.
TEST(Equivalence, FailsAsOftenAsItsFalseAlarmRateSays) {
  SeedEstimate estimate;
  estimate.standardDeviation = 1;
  estimate.seeds = 8;
  for (const double offset : {0., .3}) {
    for (const double tolerance : {1.2, 1.6, 2.2}) {
      const double expected = FalseAlarmRate(estimate, offset, tolerance);
      const double error = 5 * std::sqrt(expected * (1 - expected) / kRuns);
      EXPECT_NEAR(ShareThatFails(offset, tolerance), expected, error) << offset << " " << tolerance;
    }
  }
}

TEST(Equivalence, WithoutSpreadFailsNeverOrAlways) {
  SeedEstimate estimate;
  estimate.seeds = 8;
  EXPECT_EQ(FalseAlarmRate(estimate, .5, 1), 0);
  EXPECT_EQ(FalseAlarmRate(estimate, 2, 1), 1);
}

}  // namespace
}  // namespace exphoton
