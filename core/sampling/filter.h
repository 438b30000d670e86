// SPDX-License-Identifier: BSD-2-Clause
// Filter: a pixel reconstruction filter, used by importance sampling (Ernst, Stamminger and Greiner
// 2006, "Filter Importance Sampling"): the position of a camera sample is drawn from |filter| round
// its pixel's centre and contributes to that pixel alone, with weight +-1. So a pixel is a sum over
// its own samples only, whatever the tiles or the crop.
#pragma once

#include "core/math/vec.h"

namespace exphoton {

struct FilterSample {
  Point2 offset;  // from the pixel's centre, in pixels
  Real weight;    // f / pdf up to a common constant, so that its mean is 1 over [0,1)^2
};

class Filter {
 public:
  virtual ~Filter() = default;
  virtual Real XWidth() const = 0;  // half-widths in pixels; 0 outside
  virtual Real YWidth() const = 0;
  virtual Real Evaluate(Point2 offset) const = 0;  // not normalised
  virtual FilterSample Sample(Point2 u) const = 0;
};

}  // namespace exphoton
