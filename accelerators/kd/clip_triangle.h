// SPDX-License-Identifier: BSD-2-Clause
// ClipTriangle returns the bounds of the part of a triangle within a box. These bounds are tighter
// than the intersection of the triangle's bounds with the box, so a large triangle does not fall
// into every cell that its bounds overlap.
#pragma once

#include <array>

#include "core/math/bounds.h"

namespace exphoton {

// Returns empty bounds if the triangle misses the box. The result is exact to double rounding; the
// caller adds a margin.
Bounds3 ClipTriangle(const std::array<Point3, 3>& triangle, const Bounds3& box);

}  // namespace exphoton
