// SPDX-License-Identifier: BSD-2-Clause
// How near a point-like light may seem: a light that lies on a surface must stay finite, yet one
// lamp in a small room of a huge world must not lose its light. No absolute length: all scales with
// the scene.
#pragma once

#include <algorithm>

#include "core/math/bounds.h"

namespace exphoton {

class LeastDistance {
 public:
  LeastDistance() = default;
  explicit LeastDistance(const Sphere3& world) : radius_(world.radius) {}

  // Squared: 2^-20 of what is smaller, the world's radius or the coordinates of the two points (a
  // few times what rounding leaves uncertain there), and at least 2^-50 of the world's radius.
  Real Squared(const Point3& a, const Point3& b) const {
    const Real size = std::max(MaxAbs(a), MaxAbs(b));
    const Real least =
        std::clamp(size * Real(0x1p-20), radius_ * Real(0x1p-50), radius_ * Real(0x1p-20));
    return least * least;
  }

 private:
  static Real MaxAbs(const Point3& p) {
    return std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)});
  }

  Real radius_ = 0;
};

}  // namespace exphoton
