// SPDX-License-Identifier: BSD-2-Clause
// LDR-FLIP: how different two pictures look when one flips between them. Andersson et al. 2020,
// "FLIP: A Difference Evaluator for Alternating Images", HPG. Not HDR-FLIP: both pictures are shown
// at one exposure, stated below.
#pragma once

#include <vector>

#include "core/imaging/image.h"

namespace exphoton {

// In [0, 1] for every pixel, row by row; 67 pixels a degree. Both pictures are scaled so that the
// reference's mean luminance is 0.18 and clamped to [0, 1]; values that are not finite count as 0.
// Throws ImageError where sizes differ or a channel is missing.
std::vector<float> FlipMap(const Image& reference, const Image& image);

// Its mean over the picture.
double FlipError(const Image& reference, const Image& image);

// What linear values are multiplied by for display: the mean luminance of the finite pixels becomes
// 0.18; 1 for a black picture.
double DisplayScale(const Image& reference);

// The same as FlipMap for pictures that are display-referred already (linear light in [0, 1]).
std::vector<float> FlipMapOfDisplayed(const Image& reference, const Image& image);

}  // namespace exphoton
