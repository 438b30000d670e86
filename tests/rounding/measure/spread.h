// SPDX-License-Identifier: BSD-2-Clause
// SpreadOf compares pictures of one scene, with the same random numbers but other directions of
// rounding. Spreads are standard deviations relative to the value, as decimal digits that rounding
// cost: log10 of the spread in units of the float epsilon 2^-23, at least 0. All 6.9 digits are
// lost at a spread of 1.
#pragma once

#include <span>
#include <vector>

#include "core/imaging/image.h"

namespace exphoton::rounding {

struct Spread {
  double mean = 0;    // digits that the mean of the picture lost
  double median = 0;  // of pixels, the median
  double worst = 0;   // of pixels, the worst
  // The share of pixels with a spread above kDecided. A random decision at an edge, or at a
  // probability of a path's end, turned out in another way there.
  double decided = 0;
};

inline constexpr double kDecided = 0x1p-10;

// Of R, G and B. A pixel's spread is relative to the sum of its value and .01 of the mean of the
// picture, so that pixels that are nearly black do not count. At least two pictures of equal size.
Spread SpreadOf(std::span<const Image> pictures);

// Returns the digits that values lost; 0 if all are equal. `scale` is what they are relative to.
double DigitsLost(std::span<const double> values, double scale);
double DigitsLost(double relativeSpread);

}  // namespace exphoton::rounding
