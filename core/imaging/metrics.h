// SPDX-License-Identifier: BSD-2-Clause
// Differences between two images of the same size, over the channels R, G, B.
#pragma once

#include "core/imaging/image.h"

namespace exphoton {

struct ImageDifference {
  double mse = 0;         // mean of (x - r)^2
  double relMse = 0;      // mean of (x - r)^2 / (r^2 + 0.01)
  double meanError = 0;   // mean of x - r
  double meanReference = 0;
  double relativeMeanError = 0;  // meanError / meanReference
  long long nonFinitePixels = 0;  // in either image; left out of the means
};

// Throws ImageError where sizes differ or a channel is missing.
ImageDifference CompareImages(const Image& reference, const Image& image);

}  // namespace exphoton
