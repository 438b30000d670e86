// SPDX-License-Identifier: BSD-2-Clause
// DenoiseLayers holds the data of one picture that denoising reads, pixel by pixel.
#pragma once

#include <array>
#include <vector>

#include "core/imaging/image.h"

namespace exphoton {

struct DenoiseLayers {
  int width = 0, height = 0;
  std::array<std::vector<float>, 2> halves;  // three channels per pixel; no value is infinite
  std::vector<float> variance;               // of a half: three channels per pixel
  std::vector<float> features;               // kFeatures channels per pixel
  std::vector<float> tolerances;             // squares of the differences that count as none
  std::vector<char> isValid;                 // all values of the pixel are finite

  static constexpr int kFeatures = 7;  // albedo, shading normal, depth

  std::size_t At(int x, int y) const {
    return std::size_t(y) * std::size_t(width) + std::size_t(x);
  }
};

DenoiseLayers ReadDenoiseLayers(const Image& picture);
// Sets the variance from the halves. ReadDenoiseLayers has done so.
void EstimateVariance(DenoiseLayers* layers);

}  // namespace exphoton
