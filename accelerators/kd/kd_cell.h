// SPDX-License-Identifier: BSD-2-Clause
// One step of construction: whether a cell is split, and which items its parts get.
#pragma once

#include "accelerators/kd/kd_split.h"

namespace exphoton {

// What keeps the tree finite.
struct KdLimits {
  int depth = 0;       // levels left
  int badSplits = 0;   // above this cell, that did not pay by themselves
  double entries = 0;  // this cell's share of all entries that leaves may have together
};

struct KdCell {
  Bounds3 bounds;
  KdLimits limits;

  bool IsSplittable(std::size_t items, const KdCosts& costs) const {
    return items > costs.maxPrimitives && limits.depth > 0;
  }
  // Whether the cheapest split is to be made; counts it where it does not pay by itself.
  bool Accepts(const KdSplit& split, std::size_t items, const KdCosts& costs);
};

// A cell cut in two.
struct KdCut {
  int axis;
  Real position;
  KdCell below, above;

  KdCut(const KdCell& cell, const KdSplit& split);
  // Gives the parts their limits once it is known how many items they have. False where the cell
  // had better stay whole.
  bool Share(std::size_t items, std::size_t itemsBelow, std::size_t itemsAbove);
};

// Its bounds, with the margin that keeps every hit within.
Bounds3 KdItemBounds(const Bounds3& bounds);

// Adds items to those of the two parts, clipped to them.
void PartKdItems(const PrimitiveSet& primitives, std::span<const KdItem> items, const KdCut& cut,
                 std::vector<KdItem>* below, std::vector<KdItem>* above);

}  // namespace exphoton
