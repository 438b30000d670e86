// SPDX-License-Identifier: BSD-2-Clause
// IsWithin is the equivalence test of a Monte Carlo mean. The quantiles of Student's t distribution
// are from the usual tables.
#include "tests/support/equivalence.h"

#include <algorithm>
#include <cmath>

namespace exphoton {

double StudentQuantile995(int degrees) {
  static constexpr double kTable[] = {63.657, 9.925, 5.841, 4.604, 4.032, 3.707, 3.499, 3.355,
                                      3.250,  3.169, 3.106, 3.055, 3.012, 2.977, 2.947, 2.921,
                                      2.898,  2.878, 2.861, 2.845, 2.831, 2.819, 2.807, 2.797,
                                      2.787,  2.779, 2.771, 2.763, 2.756, 2.750, 2.744};
  constexpr int kEntries = int(sizeof kTable / sizeof *kTable);
  if (degrees < 1) return kTable[0];
  if (degrees <= kEntries) return kTable[degrees - 1];
  // The Cornish-Fisher expansion about the normal quantile is exact to 4 digits here.
  const double z = 2.5758293;
  return z + (z * z * z + z) / (4.0 * degrees);
}

SeedEstimate EstimateFrom(std::span<const double> meansOfSeeds) {
  SeedEstimate estimate;
  const double count = double(meansOfSeeds.size());
  estimate.seeds = int(meansOfSeeds.size());
  for (const double mean : meansOfSeeds) estimate.mean += mean / count;
  double squares = 0;
  for (const double mean : meansOfSeeds) squares += (mean - estimate.mean) * (mean - estimate.mean);
  estimate.standardDeviation = std::sqrt(squares / (count - 1));
  const double quantile = StudentQuantile995(int(meansOfSeeds.size()) - 1);
  estimate.halfWidth = quantile * estimate.standardDeviation / std::sqrt(count);
  return estimate;
}

// The mean of the seeds is normal and independent of their variance, which is chi-square with K - 1
// degrees of freedom. The midpoint rule integrates over the variance.
double FalseAlarmRate(const SeedEstimate& estimate, double offset, double tolerance) {
  const int degrees = estimate.seeds - 1;
  const double sigma = estimate.standardDeviation / std::sqrt(double(estimate.seeds));
  if (!(sigma > 0)) return std::abs(offset) <= tolerance ? 0 : 1;
  const auto tail = [](double z) { return std::erfc(z / std::sqrt(2.)) / 2; };  // of the normal
  constexpr int kSteps = 4000;
  const double end = degrees + 12 * std::sqrt(2. * degrees) + 40, step = end / kSteps;
  double weights = 0, failing = 0;
  for (int i = 0; i < kSteps; ++i) {
    const double x = (i + .5) * step;
    const double weight = std::exp((degrees / 2. - 1) * std::log(x) - x / 2);
    const double room = tolerance - StudentQuantile995(degrees) * sigma * std::sqrt(x / degrees);
    const double fails =
        room < 0 ? 1 : tail((room - offset) / sigma) + tail((room + offset) / sigma);
    weights += weight;
    failing += weight * std::min(fails, 1.);
  }
  return failing / weights;
}

testing::AssertionResult IsWithin(double relativeTolerance, const SeedEstimate& estimate,
                                  double truth) {
  return IsWithinAbsolute(relativeTolerance * std::abs(truth), estimate, truth);
}

testing::AssertionResult IsWithinAbsolute(double tolerance, const SeedEstimate& estimate,
                                          double truth) {
  const double error = std::abs(estimate.mean - truth);
  const bool isWithin = error + estimate.halfWidth <= tolerance;  // false for NaN
  return (isWithin ? testing::AssertionSuccess() : testing::AssertionFailure())
         << "mean " << estimate.mean << " +- " << estimate.halfWidth << ", truth " << truth
         << ", tolerance " << tolerance
         << (estimate.halfWidth > tolerance ? " (inconclusive: too few samples)" : "");
}

}  // namespace exphoton
