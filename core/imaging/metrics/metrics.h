// SPDX-License-Identifier: BSD-2-Clause
// Differences between two images of the same size, over the channels R, G, B. Pixels that are not
// finite in either image are counted and excluded from all other results.
#pragma once

#include <array>
#include <optional>

#include "core/imaging/image.h"

namespace exphoton {

inline constexpr double kRelMseOffset = 0.01;  // keeps dark reference pixels from dominating

// The weight of a squared error in relMSE: 1 / (r^2 + 0.01).
constexpr double RelMseWeight(double reference) {
  return 1 / (reference * reference + kRelMseOffset);
}

struct ImageDifference {
  double mse = 0;            // mean of (x - r)^2
  double relMse = 0;         // mean of (x - r)^2 / (r^2 + 0.01)
  double trimmedRelMse = 0;  // relMse without the worst thousandth of the pixels
  double p99 = 0;            // 99 % of the pixels have at most this sqrt(relMSE)
  double meanError = 0;      // mean of x - r
  double meanReference = 0;
  double relativeMeanError = 0;   // meanError / meanReference
  long long nonFinitePixels = 0;  // in either image
};

// Returns the indices of the channels R, G, B. Throws ImageError that lists the existing channels;
// `name` names the image in the message.
std::array<int, 3> FindColors(const Image& image, const std::string& name);

// Throws ImageError if sizes differ or a channel is missing.
ImageDifference CompareImages(const Image& reference, const Image& image);

// Returns these channels. R, G, B: x - r. relative.R, .G, .B: (x - r) / sqrt(r^2 + 0.01). relMSE.Y:
// the mean over the colours of the squared relative error. FLIP.Y: see flip.h. The attribute
// "comments" describes them.
Image DifferenceImage(const Image& reference, const Image& image);

// Returns a picture of the signed relative error, averaged over the colours or of one channel (0 to
// 2): red where x is
// brighter than r, blue where it is darker, white where both are equal. The colour saturates at an
// error of `fullScale`. Non-finite pixels are yellow. Values are linear, for WritePng.
Image SignedErrorImage(const Image& reference, const Image& image, double fullScale,
                       std::optional<int> channel = {});

}  // namespace exphoton
