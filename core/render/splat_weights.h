// SPDX-License-Identifier: BSD-2-Clause
// SplatWeights holds the weights of a camera sample in the pixels around it, for filters with
// negative lobes. Importance sampling would give such filters weights of both signs, whose noise is
// large. docs/decisions/0036-filters-with-negative-lobes.md has the measurements.
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "core/sampling/filter.h"

namespace exphoton {

bool HasNegativeValues(const Filter& filter);

class SplatWeights {
 public:
  // Returns null if samples are to be drawn by Filter::Sample: the filter has no negative values,
  // it is so wide that splatting would be slow, or so narrow that splatting would be noisier.
  static std::unique_ptr<const SplatWeights> Of(const Filter& filter);
  // The filter must outlive this object. Its integral must be positive.
  explicit SplatWeights(const Filter& filter);

  // A sample reaches this number of pixels in each direction.
  int Reach() const { return reach_; }
  int Width() const { return 2 * reach_ + 1; }
  // Writes Width()^2 weights, row by row, of a sample at this position within its pixel, in
  // [0,1]^2. The mean of the sum of the weights that a pixel receives from one sample per pixel
  // is 1.
  void Fill(Point2 place, std::vector<double>* weights) const;

 private:
  const Filter& filter_;
  int reach_;
  bool isSeparable_;
  double scale_;  // 1 / integral
};

}  // namespace exphoton
