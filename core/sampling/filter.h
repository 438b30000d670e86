// SPDX-License-Identifier: BSD-2-Clause
// Filter is a pixel reconstruction filter. A filter without negative values is importance sampled
// (Ernst, Stamminger and Greiner 2006, "Filter Importance Sampling"): the position of a camera
// sample is drawn from the filter around its pixel's centre, and the sample contributes to this
// pixel only. Filters with negative values are importance sampled, too, if they are narrower than
// about a pixel or too wide. Samples of other filters are uniform in their pixel and contribute to
// all pixels in the filter's support (core/render/splat_weights.h).
#pragma once

#include "core/math/vec.h"

namespace exphoton {

struct FilterSample {
  Point2 offset;  // from the pixel's centre, in pixels
  Real weight;    // f / pdf, scaled so that its mean over u in [0,1)^2 is 1
};

class Filter {
 public:
  virtual ~Filter() = default;
  virtual Real XWidth() const = 0;  // half-width in pixels; the filter is 0 outside
  virtual Real YWidth() const = 0;
  virtual Real Evaluate(Point2 offset) const = 0;  // not normalised
  virtual FilterSample Sample(Point2 u) const = 0;
};

}  // namespace exphoton
