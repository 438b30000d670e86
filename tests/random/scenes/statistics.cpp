// SPDX-License-Identifier: BSD-2-Clause
// The tails of Student's and the binomial distribution use the incomplete beta function. Lentz's
// method evaluates this function as a continued fraction (Abramowitz and Stegun 26.5.8).
#include "tests/random/scenes/statistics.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace exphoton::random_scenes {
namespace {

double NotZero(double value) { return std::abs(value) < 1e-300 ? 1e-300 : value; }

double BetaFraction(double a, double b, double x) {
  double c = 1, d = 1 / NotZero(1 - (a + b) * x / (a + 1)), value = d;
  for (int m = 1; m < 10000; ++m) {
    const double even = m * (b - m) * x / ((a + 2 * m - 1) * (a + 2 * m));
    const double odd = -(a + m) * (a + b + m) * x / ((a + 2 * m) * (a + 2 * m + 1));
    double factor = 1;
    for (const double term : {even, odd}) {
      d = 1 / NotZero(1 + term * d);
      c = NotZero(1 + term / c);
      factor = c * d;
      value *= factor;
    }
    if (std::abs(factor - 1) < 1e-15) break;
  }
  return value;
}

}  // namespace

double IncompleteBeta(double a, double b, double x) {
  if (x <= 0) return 0;
  if (x >= 1) return 1;
  if (x > (a + 1) / (a + b + 2)) return 1 - IncompleteBeta(b, a, 1 - x);
  const double factor = std::exp(std::lgamma(a + b) - std::lgamma(a) - std::lgamma(b) +
                                 a * std::log(x) + b * std::log1p(-x));
  return factor * BetaFraction(a, b, x) / a;
}

double StudentTail(double t, double degrees) {
  const double both = IncompleteBeta(degrees / 2, .5, degrees / (degrees + t * t));
  return t >= 0 ? both / 2 : 1 - both / 2;
}

Sample SampleOf(std::span<const double> values) {
  Sample sample;
  sample.count = int(values.size());
  sample.mean = std::accumulate(values.begin(), values.end(), 0.) / sample.count;
  double squares = 0;
  for (const double value : values) squares += (value - sample.mean) * (value - sample.mean);
  sample.variance = squares / (sample.count - 1) / sample.count;
  return sample;
}

double PValueBeyond(const Sample& a, const Sample& b, double margin) {
  const double excess = std::abs(a.mean - b.mean) - margin;
  if (!(excess > 0)) return 1;
  const double variance = a.variance + b.variance;
  if (!(variance > 0)) return 0;
  const double degrees =
      variance * variance /
      (a.variance * a.variance / (a.count - 1) + b.variance * b.variance / (b.count - 1));
  return StudentTail(excess / std::sqrt(variance), degrees);
}

double PValueAbove(const Sample& a, double bound) {
  const double excess = a.mean - bound;
  if (!(excess > 0)) return 1;
  if (!(a.variance > 0)) return 0;
  return StudentTail(excess / std::sqrt(a.variance), a.count - 1);
}

std::vector<std::size_t> Rejected(std::span<const double> chances, double rate) {
  std::vector<std::size_t> order(chances.size());
  std::iota(order.begin(), order.end(), std::size_t(0));
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return chances[a] < chances[b]; });
  std::size_t rejected = 0;
  for (std::size_t i = 0; i < order.size(); ++i)
    if (chances[order[i]] <= rate * double(i + 1) / double(order.size())) rejected = i + 1;
  order.resize(rejected);
  return order;
}

double LargestFailureRate(int failures, int count) {
  if (failures >= count) return 1;
  // P(X <= failures) = 1 - I_p(failures + 1, count - failures) falls as p grows.
  double low = 0, high = 1;
  for (int i = 0; i < 200; ++i) {
    const double middle = .5 * (low + high);
    const bool isLikely = 1 - IncompleteBeta(failures + 1, count - failures, middle) > .05;
    (isLikely ? low : high) = middle;
  }
  return high;
}

}  // namespace exphoton::random_scenes
