// SPDX-License-Identifier: BSD-2-Clause
// Pictures of the page as <img> elements with their data inside.
#pragma once

#include <array>
#include <string>

#include "core/imaging/image.h"

namespace exphoton::study {

// Averages blocks of pixels until the picture is at most this wide; not finite ones become 0.
Image Shrink(const Image& image, int maxWidth);
// Fractions x0 x1 y0 y1 of the picture; at least one pixel.
Image CropOf(const Image& image, const std::array<double, 4>& fractions);

// `scale`: what values are multiplied by. alt: for people who cannot see it.
std::string PictureElement(const Image& image, double scale, const std::string& alt,
                           bool isPixelated);

// One channel in false colours, on a logarithmic scale from the 1st to the 99th percentile, with
// its legend. Values that are not above 0 are grey.
std::string MapElement(const Image& image, const std::string& channel, const std::string& unit);

// The quarter-width window in which |a - b| / (b + mean) is largest.
std::array<double, 4> WorstWindow(const Image& image, const Image& reference);

}  // namespace exphoton::study
