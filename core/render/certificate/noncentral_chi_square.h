// SPDX-License-Identifier: BSD-2-Clause
// The noncentral chi-square distribution is the one of a sum of squares of normal numbers with the
// variance 1 and with means whose squares add up to the noncentrality.
#pragma once

namespace exphoton {

// Returns z where P(X <= x) is about P(Z <= z) for a standard normal Z. Source: Sankaran 1963,
// "Approximations to the non-central chi-square distribution".
double NoncentralChiSquareScore(double x, double freedom, double noncentrality);

// Returns the largest noncentrality for which P(X <= x) is not below P(Z <= -z), or 0.
double NoncentralityBound(double x, double freedom, double z);

}  // namespace exphoton
