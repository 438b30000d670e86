// SPDX-License-Identifier: BSD-2-Clause
// OmissionSample collects small renders with and without an effect, and bounds what a picture lacks
// without it. The bounds of all effects that may be left out hold together at a level of 99 %. A
// bound is the larger one of two upper ends:
// - the root of relMSE between the two pictures, and
// - the change of the worst block of kBlock x kBlock pixels, relative to the block's light.
// Each pair of renders has photons and camera samples of its own. The mean square of a pixel's
// difference is therefore at least the square of its mean, and noise makes the bound larger, not
// smaller. With one sample per pixel this includes light that varies within the pixel.
#pragma once

#include <array>
#include <optional>
#include <vector>

namespace exphoton::cli {

struct OmissionBound {
  double change = 0;  // root of relMSE
  double block = 0;   // relative to the light of the block

  double Upper() const { return change > block ? change : block; }
};

class OmissionSample {
 public:
  static constexpr int kPairs = 5;
  static constexpr int kBlock = 8;

  using Values = std::vector<double>;  // three channels per pixel, row by row

  // Of the pictures, in pixels; > 0.
  OmissionSample(int width, int height) : width_(width), height_(height) {}

  // Adds a pair of renders. Both must have width * height * 3 finite values.
  void Add(const Values& with, const Values& without);

  // Returns the change of the mean of the picture, relative to its light. 0: there is no light.
  double MeanShare() const;
  // Returns nullopt if there are fewer than kPairs pairs, or if nothing changes in any of them: the
  // light of the effect may then be rare. bounds: the number of effects that may get a bound.
  std::optional<OmissionBound> Bound(int bounds) const;

 private:
  struct Pair {
    Values light, change;  // the latter: with - without
  };
  double BlockBound(int x0, int y0, const Values& light, double quantile) const;
  Values MeanLight() const;

  int width_, height_;
  std::vector<Pair> pairs_;
};

}  // namespace exphoton::cli
