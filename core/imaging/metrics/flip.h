// SPDX-License-Identifier: BSD-2-Clause
// LDR-FLIP measures the difference that a viewer sees when alternating between two pictures.
// Source: Andersson et al. 2020, "FLIP: A Difference Evaluator for Alternating Images", HPG. It is
// not HDR-FLIP, because both pictures are shown at a single exposure.
#pragma once

#include <vector>

#include "core/imaging/image.h"

namespace exphoton {

// Returns a value in [0, 1] for every pixel, row by row, at 67 pixels per degree. Both pictures are
// scaled so that the reference's mean luminance is 0.18, and clamped to [0, 1]. Non-finite values
// count as 0. Throws ImageError if sizes differ or a channel is missing.
std::vector<float> FlipMap(const Image& reference, const Image& image);

// Returns the mean of FlipMap over the picture.
double FlipError(const Image& reference, const Image& image);

// Returns the factor that scales linear values for display. It maps the mean luminance of the
// finite pixels to 0.18; it is 1 for a black picture.
double DisplayScale(const Image& reference);

// Same as FlipMap, for pictures that are already display-referred (linear light in [0, 1]).
std::vector<float> FlipMapOfDisplayed(const Image& reference, const Image& image);

}  // namespace exphoton
