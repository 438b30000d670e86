// SPDX-License-Identifier: BSD-2-Clause
// FilterTable tabulates one half of the axis and inverts a piecewise linear density.
#include "core/sampling/filter_table.h"

#include <algorithm>
#include <cmath>

namespace exphoton {
namespace {

// The number is even, so that the joint of a filter made of two pieces of equal width falls on a
// step.
constexpr int kCells = 1024;

}  // namespace

FilterTable::FilterTable(std::function<double(double)> f, double halfWidth)
    : f_(std::move(f)), step_(halfWidth / kCells) {
  double left = f_(0);
  values_.push_back(std::abs(left));
  for (int i = 1; i <= kCells; ++i) {
    const double right = f_(i * step_), middle = f_((i - 0.5) * step_);
    integral_ += (left + 4 * middle + right) * step_ / 6;  // Simpson
    values_.push_back(std::abs(right));
    cumulative_.push_back(cumulative_.back() + (std::abs(left) + std::abs(right)) * step_ / 2);
    left = right;
  }
}

FilterTable::Value FilterTable::Sample(Real u) const {
  // The lower half of u maps to negative x, mirrored, so that x rises with u.
  const double side = u < Real(.5) ? -1 : 1;
  const double v = std::abs(2 * double(u) - 1);
  const double target = std::min(v, 1 - 1e-12) * cumulative_.back();
  const auto above = std::upper_bound(cumulative_.begin() + 1, cumulative_.end() - 1, target);
  const auto cell = std::size_t(above - cumulative_.begin()) - 1;
  const double a = values_[cell], slope = values_[cell + 1] - a;
  const double area = (target - cumulative_[cell]) / step_;
  // Solves a t + slope t^2 / 2 = area without cancellation.
  const double denominator = a + std::sqrt(std::max(a * a + 2 * slope * area, 0.));
  const double t = denominator > 0 ? std::clamp(2 * area / denominator, 0., 1.) : 0;
  const double x = (double(cell) + t) * step_;
  const double density = (a + slope * t) / cumulative_.back();
  return {Real(side * x), density > 0 ? Real(f_(x) / (density * integral_)) : 0};
}

}  // namespace exphoton
