// SPDX-License-Identifier: BSD-2-Clause
// The choice of a splitting plane: all planes at the ends of bounds where there are few, planes
// between bins where there are many.
#pragma once

#include <array>
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

// Where items of a cell begin and end, in bins along each axis.
class KdBins {
 public:
  static constexpr std::size_t kCount = 64;

  explicit KdBins(const Bounds3& cell);
  void Add(std::span<const KdItem> items);
  void Add(const KdBins& others);  // of the same cell

 private:
  friend KdSplit FindKdSplit(const KdBins& bins, const Bounds3& cell, const KdCosts& costs);

  struct Axis {
    double low, scale;  // bins for each unit of length; 0: it has none
    std::array<std::uint32_t, kCount> begins{}, ends{};
  };
  std::array<Axis, 3> axes_;
  std::size_t items_ = 0;
};

// The cheapest plane strictly inside the cell. An item belongs below where it begins before the
// plane or lies in it, above where it ends behind the plane.
KdSplit FindKdSplit(std::span<const KdItem> items, const Bounds3& cell, const KdCosts& costs);
// The same for many items.
KdSplit FindKdSplit(const KdBins& bins, const Bounds3& cell, const KdCosts& costs);

inline bool IsBelow(const KdItem& item, int axis, Real position) {
  return item.bounds.min[axis] < position || item.bounds.max[axis] == position;
}
inline bool IsAbove(const KdItem& item, int axis, Real position) {
  return item.bounds.max[axis] > position;
}

}  // namespace exphoton
