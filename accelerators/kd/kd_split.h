// SPDX-License-Identifier: BSD-2-Clause
// FindKdSplit chooses a splitting plane. For few items it tries the planes at both ends of all
// bounds; for many items it tries the planes between bins.
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
  double cost = 0;  // expected cost of a ray that enters the cell
};

// KdBins counts, along each axis, where the items of a cell begin and end.
class KdBins {
 public:
  static constexpr std::size_t kCount = 64;

  explicit KdBins(const Bounds3& cell);
  void Add(std::span<const KdItem> items);
  void Add(const KdBins& others);  // bins of the same cell

 private:
  friend KdSplit FindKdSplit(const KdBins& bins, const Bounds3& cell, const KdCosts& costs);

  struct Axis {
    double low, scale;  // scale: bins per unit of length; 0: none
    std::array<std::uint32_t, kCount> begins{}, ends{};
  };
  std::array<Axis, 3> axes_;
  std::size_t items_ = 0;
};

// Returns the cheapest plane strictly inside the cell. An item belongs below if it begins before
// the plane or lies in it, and above if it ends behind the plane.
KdSplit FindKdSplit(std::span<const KdItem> items, const Bounds3& cell, const KdCosts& costs);
// Does the same for many items, whose bins are given.
KdSplit FindKdSplit(const KdBins& bins, const Bounds3& cell, const KdCosts& costs);

inline bool IsBelow(const KdItem& item, int axis, Real position) {
  return item.bounds.min[axis] < position || item.bounds.max[axis] == position;
}
inline bool IsAbove(const KdItem& item, int axis, Real position) {
  return item.bounds.max[axis] > position;
}

}  // namespace exphoton
