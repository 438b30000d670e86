// SPDX-License-Identifier: BSD-2-Clause
// Differences between images, summed in double over the pixels that are finite in both.
#include "core/imaging/metrics.h"

#include <array>
#include <cmath>
#include <limits>

namespace exphoton {
namespace {

constexpr double kRelMseOffset = 0.01;  // keeps black references from dominating

std::array<int, 3> FindColors(const Image& image, const char* which) {
  const std::array<int, 3> found = {image.FindChannel("R"), image.FindChannel("G"),
                                    image.FindChannel("B")};
  for (int channel : found)
    if (channel < 0) throw ImageError(std::string("the ") + which + " lacks channel R, G or B");
  return found;
}

std::string SizeText(const Image& image) {
  return std::to_string(image.Width()) + " x " + std::to_string(image.Height());
}

}  // namespace

ImageDifference CompareImages(const Image& reference, const Image& image) {
  if (reference.Width() != image.Width() || reference.Height() != image.Height()) {
    throw ImageError("the pictures differ in size: " + SizeText(reference) + " and " +
                     SizeText(image));
  }
  const std::array<int, 3> from = FindColors(reference, "reference");
  const std::array<int, 3> to = FindColors(image, "image");
  ImageDifference difference;
  double values = 0;
  for (int y = 0; y < image.Height(); ++y) {
    for (int x = 0; x < image.Width(); ++x) {
      std::array<double, 3> r, v;
      bool isFinite = true;
      for (std::size_t c = 0; c < 3; ++c) {
        r[c] = reference.At(x, y, from[c]);
        v[c] = image.At(x, y, to[c]);
        isFinite &= std::isfinite(r[c]) && std::isfinite(v[c]);
      }
      if (!isFinite) {
        ++difference.nonFinitePixels;
        continue;
      }
      for (std::size_t c = 0; c < 3; ++c) {
        const double error = v[c] - r[c];
        difference.mse += error * error;
        difference.relMse += error * error / (r[c] * r[c] + kRelMseOffset);
        difference.meanError += error;
        difference.meanReference += r[c];
      }
      values += 3;
    }
  }
  if (values == 0) return difference;
  difference.mse /= values;
  difference.relMse /= values;
  difference.meanError /= values;
  difference.meanReference /= values;
  if (difference.meanError != 0) {
    difference.relativeMeanError =
        difference.meanReference != 0
            ? difference.meanError / difference.meanReference
            : std::copysign(std::numeric_limits<double>::infinity(), difference.meanError);
  }
  return difference;
}

}  // namespace exphoton
