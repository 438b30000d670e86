// SPDX-License-Identifier: BSD-2-Clause
// The bounds of the part of a triangle within a box: tighter than the triangle's own, so that large
// triangles do not fill every cell they might cross.
#pragma once

#include <array>

#include "core/math/bounds.h"

namespace exphoton {

// Empty where the triangle misses the box. Exact to double rounding; the caller adds its margin.
Bounds3 ClipTriangle(const std::array<Point3, 3>& triangle, const Bounds3& box);

}  // namespace exphoton
