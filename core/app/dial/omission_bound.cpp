// SPDX-License-Identifier: BSD-2-Clause
#include "core/app/dial/omission_bound.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "core/imaging/metrics/metrics.h"

namespace exphoton::cli {
namespace {

constexpr double kWrong = .01;  // the chance that any of the bounds is too low

// Returns x with P(T > x) = probability for Student's t with four degrees of freedom. probability:
// in (0, 0.5). Source: Shaw 2006, "Sampling Student's T distribution - use of the inverse
// cumulative distribution function".
double StudentQuantile(double probability) {
  static_assert(OmissionSample::kPairs - 1 == 4);
  const double root = std::sqrt(std::max(4 * probability * (1 - probability), 0.));
  const double third = std::acos(std::clamp(root, 0., 1.)) / 3;
  return 2 * std::sqrt(std::max(std::cos(third) / root - 1, 0.));
}

struct Spread {
  double quantile;                 // of Student's t, for the bound of the mean
  double mean = 0, deviation = 0;  // the latter: standard deviation of one value

  double Distance(std::size_t count) const {
    return quantile * deviation / std::sqrt(double(count));
  }
};

Spread SpreadOf(std::span<const double> values, double quantile) {
  Spread spread{quantile};
  for (const double value : values) spread.mean += value / double(values.size());
  double squares = 0;
  for (const double value : values) squares += (value - spread.mean) * (value - spread.mean);
  spread.deviation = std::sqrt(squares / double(values.size() - 1));
  return spread;
}

double Sum(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += value;
  return sum;
}

}  // namespace

void OmissionSample::Add(const Values& with, const Values& without) {
  Pair pair{with, with};
  for (std::size_t i = 0; i < with.size(); ++i) pair.change[i] -= without[i];
  pairs_.push_back(std::move(pair));
}

double OmissionSample::MeanShare() const {
  double light = 0, change = 0;
  for (const Pair& pair : pairs_) light += Sum(pair.light), change += Sum(pair.change);
  return light > 0 ? change / light : 0;
}

OmissionSample::Values OmissionSample::MeanLight() const {
  Values mean(pairs_.front().light.size());
  for (const Pair& pair : pairs_)
    for (std::size_t i = 0; i < mean.size(); ++i) mean[i] += pair.light[i] / double(pairs_.size());
  return mean;
}

std::optional<OmissionBound> OmissionSample::Bound(int bounds) const {
  if (pairs_.size() < std::size_t(kPairs)) return std::nullopt;
  const Values light = MeanLight();
  std::vector<double> squares;
  for (const Pair& pair : pairs_) {
    double sum = 0;
    for (std::size_t i = 0; i < light.size(); ++i)
      sum += pair.change[i] * pair.change[i] * RelMseWeight(light[i]);
    squares.push_back(sum / double(light.size()));
  }
  const double quantile = StudentQuantile(kWrong / bounds);
  const Spread spread = SpreadOf(squares, quantile);
  if (!(spread.mean > 0)) return std::nullopt;
  OmissionBound bound;
  bound.change = std::sqrt(spread.mean + spread.Distance(squares.size()));
  for (int y = 0; y < height_; y += kBlock)
    for (int x = 0; x < width_; x += kBlock)
      bound.block = std::max(bound.block, BlockBound(x, y, light, quantile));
  return bound;
}

// The largest of these bounds holds for the block with the largest true change, because the bound
// of this block does.
double OmissionSample::BlockBound(int x0, int y0, const Values& light, double quantile) const {
  const int x1 = std::min(x0 + kBlock, width_), y1 = std::min(y0 + kBlock, height_);
  const double count = 3. * (x1 - x0) * (y1 - y0);
  const auto mean = [&](const Values& values) {
    double sum = 0;
    for (int y = y0; y < y1; ++y)
      for (int i = 3 * (y * width_ + x0); i < 3 * (y * width_ + x1); ++i)
        sum += values[std::size_t(i)];
    return sum / count;
  };
  std::vector<double> changes;
  for (const Pair& pair : pairs_) changes.push_back(mean(pair.change));
  const Spread spread = SpreadOf(changes, quantile);
  return (std::abs(spread.mean) + spread.Distance(changes.size())) *
         std::sqrt(RelMseWeight(mean(light)));
}

}  // namespace exphoton::cli
