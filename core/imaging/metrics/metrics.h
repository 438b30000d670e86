// SPDX-License-Identifier: BSD-2-Clause
// Differences between two images of the same size, over the channels R, G, B. Pixels that are not
// finite in either image are counted and left out of everything else.
#pragma once

#include <array>

#include "core/imaging/image.h"

namespace exphoton {

inline constexpr double kRelMseOffset = 0.01;  // keeps black references from dominating

// The weight of a squared error in relMSE: 1 / (r^2 + 0.01).
constexpr double RelMseWeight(double reference) {
  return 1 / (reference * reference + kRelMseOffset);
}

struct ImageDifference {
  double mse = 0;            // mean of (x - r)^2
  double relMse = 0;         // mean of (x - r)^2 / (r^2 + 0.01)
  double trimmedRelMse = 0;  // the same without the worst thousandth of the pixels
  double p99 = 0;            // 99 % of the pixels have a smaller sqrt(their relMSE)
  double meanError = 0;      // mean of x - r
  double meanReference = 0;
  double relativeMeanError = 0;   // meanError / meanReference
  long long nonFinitePixels = 0;  // in either image
};

// Where the channels R, G, B are. Throws ImageError that lists what there is; `name` says whose.
std::array<int, 3> FindColors(const Image& image, const std::string& name);

// Throws ImageError where sizes differ or a channel is missing.
ImageDifference CompareImages(const Image& reference, const Image& image);

// Channels R, G, B: x - r; relative.R, .G, .B: (x - r) / sqrt(r^2 + 0.01); relMSE.Y: its square's
// mean over the colours; FLIP.Y (flip.h). Attributes say so.
Image DifferenceImage(const Image& reference, const Image& image);

// Red where x is brighter than r, blue where darker, white where equal, full colour at a relative
// error (mean over the colours) of `fullScale`; yellow: not finite. Linear values for WritePng.
Image SignedErrorImage(const Image& reference, const Image& image, double fullScale);

}  // namespace exphoton
