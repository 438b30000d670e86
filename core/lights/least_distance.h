// SPDX-License-Identifier: BSD-2-Clause
// LeastDistance is the smallest distance at which a point-like light is evaluated. A light that
// lies on a surface must stay finite, but a lamp in a small room of a huge world must not lose its
// light. There is no absolute length: everything scales with the scene.
#pragma once

#include <algorithm>

#include "core/math/bounds.h"

namespace exphoton {

class LeastDistance {
 public:
  LeastDistance() = default;
  explicit LeastDistance(const Sphere3& world) : radius_(world.radius) {}

  // Returns the squared least distance. The distance is 2^-20 of the largest coordinate of the two
  // points, which is a few times their rounding error. It is at most 2^-20 and at least 2^-50 of
  // the world's radius.
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
