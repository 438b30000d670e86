// SPDX-License-Identifier: BSD-2-Clause
// LiesBehind proves that a box lies behind a one-sided surface, so that no light from the surface
// reaches the box.
#pragma once

#include <initializer_list>

#include "core/math/bounds.h"

namespace exphoton {

// Returns true only if the box lies behind a flat surface: no ray that leaves the convex hull of
// `corners` to the side of the normal hits the box. The answer allows for rounded normals and
// directions, so a box that lies just behind the surface may count as one in front of it.
inline bool LiesBehind(const Bounds3& box, const Normal3& normal,
                       std::initializer_list<Point3> corners) {
  constexpr double kMargin = 1e-4;  // sine of an angle; far more than the rounding of a direction
  for (const Point3& corner : corners) {
    double height = 0, reach2 = 0;  // of the box above the surface; of its farthest point
    for (int axis = 0; axis < 3; ++axis) {
      const double low = double(box.min[axis]) - double(corner[axis]);
      const double high = double(box.max[axis]) - double(corner[axis]);
      const double n = double(normal[axis]);
      height += n * (n > 0 ? high : low);
      reach2 += std::max(low * low, high * high);
    }
    if (!(height < -kMargin * std::sqrt(reach2))) return false;
  }
  return true;
}

}  // namespace exphoton
