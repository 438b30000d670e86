// SPDX-License-Identifier: BSD-2-Clause
#include "core/render/certificate/noncentral_chi_square.h"

#include <cmath>

namespace exphoton {

// A power of X is nearly normal.
double NoncentralChiSquareScore(double x, double freedom, double noncentrality) {
  const double mean = freedom + noncentrality, half = freedom + 2 * noncentrality;
  const double power = 1 - 2 * mean * (freedom + 3 * noncentrality) / (3 * half * half);
  const double p = half / (mean * mean), m = (power - 1) * (1 - 3 * power);
  const double center = 1 + power * p * (power - 1 - .5 * (2 - power) * m * p);
  const double scale = power * std::sqrt(2 * p) * (1 + .5 * m * p);
  return (std::pow(x / mean, power) - center) / scale;
}

// The score falls with the noncentrality.
double NoncentralityBound(double x, double freedom, double z) {
  double low = 0, high = 1;
  while (NoncentralChiSquareScore(x, freedom, high) > -z && high < 1e30) low = high, high *= 2;
  for (int i = 0; i < 60; ++i) {
    const double middle = (low + high) / 2;
    (NoncentralChiSquareScore(x, freedom, middle) > -z ? low : high) = middle;
  }
  return low;
}

}  // namespace exphoton
