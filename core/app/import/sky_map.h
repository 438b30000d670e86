// SPDX-License-Identifier: BSD-2-Clause
// The maps of infinite lights of version 4 are squares that keep areas: the upper hemisphere is the
// diamond in the middle, and the lower one fills the corners (Clarberg 2008, Fast Equal-Area
// Mapping of the (Hemi)Sphere using SIMD). Here they are maps of latitude and longitude.
#pragma once

#include <array>

#include "core/imaging/image.h"

namespace exphoton::cli {

// Returns the point of the unit square of a unit direction; z is up.
std::array<double, 2> SquareOfDirection(const std::array<double, 3>& direction);

// Returns the map of latitude and longitude with twice the width and the same height. The image
// must be square and have the channels R, G and B.
Image LatitudeMapOf(const Image& square);

}  // namespace exphoton::cli
