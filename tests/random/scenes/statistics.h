// SPDX-License-Identifier: BSD-2-Clause
// The statistics of a run over random scenes: one-sided t-tests of equivalence, the rule of
// Benjamini and Hochberg (1995), and bounds of a failure rate (Clopper and Pearson 1934).
#pragma once

#include <span>
#include <vector>

namespace exphoton::random_scenes {

// The regularised incomplete beta function I_x(a, b), a, b > 0, 0 <= x <= 1.
double IncompleteBeta(double a, double b, double x);

// P(T > t) for Student's t with `degrees` degrees of freedom, which need not be whole.
double StudentTail(double t, double degrees);

// Means of independent seeds.
struct Sample {
  double mean = 0;
  double variance = 0;  // of the mean
  int count = 0;
};
Sample SampleOf(std::span<const double> values);

// The probability of a difference |a - b| as large as this or larger where the true one is
// `margin` (Welch's test). 1 where the difference is within the margin.
double ChanceBeyond(const Sample& a, const Sample& b, double margin);
// The same for a mean a that may be at most `bound`.
double ChanceAbove(const Sample& a, double bound);

// Which of the hypotheses are rejected where at most the share `rate` of the rejections is to be
// false: the indices of the smallest p-values.
std::vector<std::size_t> Rejected(std::span<const double> chances, double rate);

// The upper 95 % bound of the failure rate after `failures` failures in `count` trials.
double LargestFailureRate(int failures, int count);

}  // namespace exphoton::random_scenes
