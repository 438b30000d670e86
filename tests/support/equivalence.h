// SPDX-License-Identifier: BSD-2-Clause
// IsWithin is the rule of every Monte Carlo test of a mean. K independent seeds give K means. The
// test passes if |mean - truth| plus the half-width of the 99 % confidence interval (Student's t)
// is within the tolerance. A half-width beyond the tolerance fails, so noise never makes a test
// pass.
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <span>
#include <vector>

namespace exphoton {

inline constexpr int kGateSeeds = 8;

struct SeedEstimate {
  double mean = 0;
  double standardDeviation = 0;  // of one seed's mean
  double halfWidth = 0;          // t(0.995, K - 1) s / sqrt(K)
  int seeds = 0;                 // K
};

// Returns the quantile t(0.995, degrees) of Student's distribution.
double StudentQuantile995(int degrees);

SeedEstimate EstimateFrom(std::span<const double> meansOfSeeds);

// Calls measure(seed) for `count` seeds, 1000 apart.
template <class Measure>  // double(std::uint64_t seed)
SeedEstimate EstimateOverSeeds(Measure&& measure, int count = kGateSeeds) {
  std::vector<double> means;
  for (int k = 0; k < count; ++k) means.push_back(measure(std::uint64_t(k) * 1000 + 1));
  return EstimateFrom(means);
}

// Returns the probability that the same number of other seeds fails the rule. The seeds' means are
// assumed to be normal with the estimate's standard deviation and a mean that differs from the
// truth by `offset`.
double FalseAlarmRate(const SeedEstimate& estimate, double offset, double tolerance);

// The tolerance is relative to |truth|.
testing::AssertionResult IsWithin(double relativeTolerance, const SeedEstimate& estimate,
                                  double truth);
testing::AssertionResult IsWithinAbsolute(double tolerance, const SeedEstimate& estimate,
                                          double truth);

}  // namespace exphoton
