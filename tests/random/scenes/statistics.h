// SPDX-License-Identifier: BSD-2-Clause
// These functions are the statistics of a run over random scenes: one-sided t-tests of equivalence,
// the rule of Benjamini and Hochberg (1995), and bounds on a failure rate (Clopper and Pearson
// 1934).
#pragma once

#include <span>
#include <vector>

namespace exphoton::random_scenes {

// Returns the regularised incomplete beta function I_x(a, b) for a, b > 0 and 0 <= x <= 1.
double IncompleteBeta(double a, double b, double x);

// Returns P(T > t) for Student's t with `degrees` degrees of freedom, which need not be whole.
double StudentTail(double t, double degrees);

// Sample describes the means of independent seeds.
struct Sample {
  double mean = 0;
  double variance = 0;  // of the mean
  int count = 0;
};
Sample SampleOf(std::span<const double> values);

// Returns the probability of a difference |a - b| at least this large if the true difference is
// `margin` (Welch's test), or 1 if the difference is within the margin.
double PValueBeyond(const Sample& a, const Sample& b, double margin);
// Returns the same probability for a mean a whose true value is at most `bound`.
double PValueAbove(const Sample& a, double bound);

// Returns the hypotheses to reject so that at most the fraction `rate` of the rejections is false:
// the indices of the smallest p-values.
std::vector<std::size_t> Rejected(std::span<const double> chances, double rate);

// Returns the upper 95 % bound on the failure rate after `failures` failures in `count` trials.
double LargestFailureRate(int failures, int count);

}  // namespace exphoton::random_scenes
