// SPDX-License-Identifier: BSD-2-Clause
// FilterTable draws from |f| for one axis of a separable filter that has no simple inverse. The
// density is piecewise linear through |f| at equal steps, so the weights differ from +-constant
// only where f changes its sign.
#pragma once

#include <functional>
#include <vector>

#include "core/math/real.h"

namespace exphoton {

class FilterTable {
 public:
  struct Value {
    Real x;       // in [-halfWidth, halfWidth], rising with u
    Real weight;  // f(x) / (density * integral of f); its mean over u is 1
  };

  // f is even, given for x >= 0, and 0 beyond halfWidth. Its integral must be positive.
  FilterTable(std::function<double(double)> f, double halfWidth);
  Value Sample(Real u) const;

 private:
  std::function<double(double)> f_;
  double step_, integral_ = 0;         // integral_: of f over [0, halfWidth]
  std::vector<double> values_;         // |f| at the steps
  std::vector<double> cumulative_{0};  // integral of the piecewise linear |f| up to each step
};

}  // namespace exphoton
