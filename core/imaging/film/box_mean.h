// SPDX-License-Identifier: BSD-2-Clause
// BoxMean smooths a picture, for estimates that divide by the local radiance.
#pragma once

#include <cstddef>
#include <vector>

namespace exphoton {

// Returns the mean over the 5 x 5 pixels round each pixel, clipped to the image. `values` has three
// channels per pixel.
std::vector<float> BoxMean(const std::vector<float>& values, std::size_t width);

}  // namespace exphoton
