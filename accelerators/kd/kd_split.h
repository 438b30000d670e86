// SPDX-License-Identifier: BSD-2-Clause
// The choice of a splitting plane: all planes at the ends of bounds where there are few, planes
// between bins where there are many.
#pragma once

#include <span>

#include "accelerators/kd/kd_build.h"

namespace exphoton {

struct KdItem {
  std::uint32_t id;
  Bounds3 bounds;  // clipped to the cell, with margin
};

struct KdSplit {
  int axis = -1;  // -1: there is no plane inside the cell
  float position = 0;
  double cost = 0;  // expected, with the cell's own area as unit
};

// The cheapest plane strictly inside the cell. An item belongs below where it begins before the
// plane or lies in it, above where it ends behind the plane.
KdSplit FindKdSplit(std::span<const KdItem> items, const Bounds3& cell, const KdCosts& costs);

inline bool IsBelow(const KdItem& item, int axis, Real position) {
  return item.bounds.min[axis] < position || item.bounds.max[axis] == position;
}
inline bool IsAbove(const KdItem& item, int axis, Real position) {
  return item.bounds.max[axis] > position;
}

}  // namespace exphoton
