// SPDX-License-Identifier: BSD-2-Clause
// KdCell decides whether a cell is split. KdCut and PartKdItems distribute its items to the two
// parts.
#pragma once

#include "accelerators/kd/kd_split.h"

namespace exphoton {

// KdLimits keeps the tree finite.
struct KdLimits {
  int depth = 0;       // levels left
  int badSplits = 0;   // splits above this cell that cost more than a leaf
  double entries = 0;  // item references that all leaves below this cell may have together
};

struct KdCell {
  Bounds3 bounds;
  KdLimits limits;

  bool IsSplittable(std::size_t items, const KdCosts& costs) const {
    return items > costs.maxPrimitives && limits.depth > 0;
  }
  // Returns whether the cheapest split is to be made. Counts the split if it costs more than a
  // leaf.
  bool Accepts(const KdSplit& split, std::size_t items, const KdCosts& costs);
};

// KdCut is a cell cut in two.
struct KdCut {
  int axis;
  Real position;
  KdCell below, above;

  KdCut(const KdCell& cell, const KdSplit& split);
  // Divides the cell's limits between its parts, in proportion to their items. Returns false if the
  // cell should stay whole.
  bool Share(std::size_t items, std::size_t itemsBelow, std::size_t itemsAbove);
};

// Pads the bounds of a primitive by a margin that keeps every hit inside.
Bounds3 KdItemBounds(const Bounds3& bounds);

// Appends each item to the part or parts that it belongs to. The bounds of an item in both parts
// are clipped to each of them.
void PartKdItems(const PrimitiveSet& primitives, std::span<const KdItem> items, const KdCut& cut,
                 std::vector<KdItem>* below, std::vector<KdItem>* above);

}  // namespace exphoton
