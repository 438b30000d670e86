// SPDX-License-Identifier: BSD-2-Clause
// ChiSquareTail: series and continued fraction of the incomplete gamma function (Abramowitz and
// Stegun 1964, 6.5.29 and 6.5.31).
#include "core/math/chi_square.h"

#include <algorithm>
#include <cmath>

namespace exphoton {

double ChiSquareTail(double x, double degrees) {
  if (degrees <= 0) return x > 0 ? 0 : 1;
  if (!(x > 0)) return 1;
  const double a = degrees / 2, z = x / 2;
  const double front = std::exp(a * std::log(z) - z - std::lgamma(a));
  if (z < a + 1) {
    double term = 1 / a, sum = term;
    for (int k = 1; k < 100000 && term > 1e-15 * sum; ++k) sum += term *= z / (a + k);
    return std::clamp(1 - front * sum, 0.0, 1.0);
  }
  // The continued fraction is evaluated by the modified method of Lentz.
  double b = z + 1 - a, c = 1e300, d = 1 / b, h = d;
  for (int k = 1; k < 100000; ++k) {
    const double an = -k * (k - a);
    b += 2;
    d = 1 / (an * d + b);
    c = b + an / c;
    h *= c * d;
    if (std::abs(c * d - 1) < 1e-14) break;
  }
  return std::clamp(front * h, 0.0, 1.0);
}

// Bisection of the logarithm of x. The median is below the mean, which is `degrees`.
double ChiSquareQuantile(double probability, double degrees) {
  double low = -100, high = std::log(degrees);
  for (int i = 0; i < 60; ++i) {
    const double middle = (low + high) / 2;
    (1 - ChiSquareTail(std::exp(middle), degrees) > probability ? high : low) = middle;
  }
  return std::exp(high);
}

}  // namespace exphoton
