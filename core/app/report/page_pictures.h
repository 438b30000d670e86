// SPDX-License-Identifier: BSD-2-Clause
// PictureElement and MapFigure return pictures of the report as elements with embedded data.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "core/app/analysis/results.h"
#include "core/app/report/template.h"
#include "core/imaging/image.h"

namespace exphoton::study {

// Averages blocks of pixels until the picture is at most this wide. Non-finite values count as 0.
Image Shrink(const Image& image, int maxWidth);
// Crops to fractions x0 x1 y0 y1 of the picture, at least one pixel.
Image CropOf(const Image& image, const std::array<double, 4>& fractions);

// `scale` multiplies all values. `alt` is the text alternative of the picture.
Html PictureElement(const Image& image, double scale, const std::string& alt, bool isPixelated);

// Shows one value a pixel, from 0 to `high`, in false colours. `like` gives the size.
Html ScalarPicture(const std::vector<float>& values, const Image& like, double high,
                   const std::string& alt);
// Returns the false colours as stops of a CSS gradient.
std::string FalseColorStops();

// Shows the map's channel of an image in false colours with a legend. The scale is logarithmic,
// from the 1st to the 99th percentile. Values that are not positive are grey. Returns no markup if
// there is no positive value.
Html MapFigure(const Image& image, const MapRecord& map);

// Returns `count` windows (as fractions x0 x1 y0 y1) in different places, with the largest sums of
// relMSE terms, each at most 1, over all pictures. A window has an eighth of width and height, or
// more in small pictures, so that it shows more than a few pixels.
std::vector<std::array<double, 4>> WorstWindows(const std::vector<Image>& images,
                                                const Image& reference, std::size_t count);

}  // namespace exphoton::study
