// SPDX-License-Identifier: BSD-2-Clause
// SplitRun splits a run of primitives in two by the surface area heuristic over 32 bins per axis.
// Source: Wald 2007, "On fast Construction of SAH-based Bounding Volume Hierarchies".
#pragma once

#include <span>

#include "accelerators/bvh/build/build_box.h"

namespace exphoton {

struct BvhRun {
  std::span<BvhItem> items;
  BuildBox box;
  BuildBox middles;  // bounds of the centres of the items' boxes
};
BvhRun MakeRun(std::span<BvhItem> items);

// BvhSplit describes a split that has reordered the items. The first part has `count` items, at
// least one and fewer than all, and lies lower on the axis.
struct BvhSplit {
  std::size_t count = 0;
  int axis = 0;
  double cost = 0;  // as two leaves: sum of half area times blocks of triangles
};
// Splits by the SAH if the centres differ, otherwise in the middle of the run. The run needs at
// least two items.
BvhSplit SplitRun(const BvhRun& run);

// Splits at the median of the centres along the axis of their largest extent. The halves are equal
// whatever the distribution.
BvhSplit HalveRun(const BvhRun& run);

// Returns the cost of a run as a leaf, in the unit of BvhSplit::cost.
double LeafCost(const BvhRun& run);

}  // namespace exphoton
