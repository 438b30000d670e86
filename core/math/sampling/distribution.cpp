// SPDX-License-Identifier: BSD-2-Clause
// Tabulated distributions are constructed from cumulative sums and sampled by their inversion.
#include "core/math/sampling/distribution.h"

#include <algorithm>

namespace exphoton {
namespace {

// Returns cumulative sums from 0 to exactly 1, or an empty vector if the sum is not positive and
// finite.
std::vector<double> CumulativeSums(std::span<const double> weights, double& sum) {
  std::vector<double> cdf(weights.size() + 1, 0.0);
  for (std::size_t i = 0; i < weights.size(); ++i) cdf[i + 1] = cdf[i] + weights[i];
  sum = cdf.back();
  if (!(sum > 0) || !std::isfinite(sum)) return {};
  for (double& c : cdf) c /= sum;
  // Entries after the last positive weight are also 1, so that a zero weight is never chosen.
  for (std::size_t i = weights.size(); i > 0 && weights[i - 1] == 0; --i) cdf[i - 1] = 1;
  cdf.back() = 1;
  return cdf;
}

// Returns the i with cdf[i] <= u < cdf[i+1]. Such an i has positive probability.
int FindInterval(const std::vector<double>& cdf, double u) {
  const auto it = std::upper_bound(cdf.begin(), cdf.end(), u);
  const auto last = static_cast<std::ptrdiff_t>(cdf.size()) - 2;
  return int(std::clamp<std::ptrdiff_t>(it - cdf.begin() - 1, 0, last));
}

}  // namespace

DiscreteDistribution::DiscreteDistribution(std::span<const double> weights)
    : cdf_(CumulativeSums(weights, sum_)), size_(int(weights.size())) {}

DiscreteDistribution::Choice DiscreteDistribution::Sample(Real u) const {
  const int i = FindInterval(cdf_, double(u));
  const double low = cdf_[std::size_t(i)], p = cdf_[std::size_t(i) + 1] - low;
  const Real remapped = std::clamp(Real((double(u) - low) / p), Real(0), kOneMinusEpsilon);
  return {i, Real(p), remapped};
}

Real DiscreteDistribution::Probability(int index) const {
  if (cdf_.empty()) return 0;
  return Real(cdf_[std::size_t(index) + 1] - cdf_[std::size_t(index)]);
}

PiecewiseConstant1D::PiecewiseConstant1D(std::span<const double> values) {
  double sum = 0;
  cdf_ = CumulativeSums(values, sum);
  integral_ = cdf_.empty() ? 0 : sum / double(values.size());
  if (cdf_.empty()) {
    cdf_.resize(values.size() + 1);
    for (std::size_t i = 0; i < cdf_.size(); ++i) cdf_[i] = double(i) / double(values.size());
  }
}

PiecewiseConstant1D::Value PiecewiseConstant1D::Sample(Real u) const {
  const int i = FindInterval(cdf_, double(u));
  const double low = cdf_[std::size_t(i)], p = cdf_[std::size_t(i) + 1] - low;
  const double x = (i + std::clamp((double(u) - low) / p, 0.0, 1.0)) / Size();
  return {std::min(Real(x), kOneMinusEpsilon), Real(p * Size()), i};
}

Real PiecewiseConstant1D::Pdf(Real x) const {
  const int i = std::clamp(int(x * Real(Size())), 0, Size() - 1);
  return Real((cdf_[std::size_t(i) + 1] - cdf_[std::size_t(i)]) * Size());
}

PiecewiseConstant2D::PiecewiseConstant2D(std::span<const double> values, int width, int height) {
  std::vector<double> rowIntegrals;
  for (int y = 0; y < height; ++y) {
    rows_.emplace_back(values.subspan(std::size_t(y) * std::size_t(width), std::size_t(width)));
    rowIntegrals.push_back(rows_.back().Integral());
  }
  marginal_ = PiecewiseConstant1D(rowIntegrals);
}

Point2 PiecewiseConstant2D::Sample(Point2 u) const {
  const auto y = marginal_.Sample(u.y);
  return {rows_[std::size_t(y.index)].Sample(u.x).x, y.x};
}

Real PiecewiseConstant2D::Pdf(Point2 p) const {
  const int row = std::clamp(int(p.y * Real(rows_.size())), 0, int(rows_.size()) - 1);
  return rows_[std::size_t(row)].Pdf(p.x) * marginal_.Pdf(p.y);
}

}  // namespace exphoton
