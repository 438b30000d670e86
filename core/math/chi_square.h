// SPDX-License-Identifier: BSD-2-Clause
// The chi-square distribution is the one of a sum of squares of normal numbers with the mean 0 and
// the variance 1.
#pragma once

namespace exphoton {

// Returns the probability that a chi-square variate with `degrees` degrees of freedom exceeds x.
double ChiSquareTail(double x, double degrees);
// Returns x with P(X <= x) = probability for such a variate X. probability: at most 1/2. degrees:
// at most some thousands.
double ChiSquareQuantile(double probability, double degrees);

}  // namespace exphoton
