// SPDX-License-Identifier: BSD-2-Clause
// Splitting a run of primitives in two by the surface area heuristic over 32 bins an axis.
// Source: Wald 2007, "On fast Construction of SAH-based Bounding Volume Hierarchies".
#pragma once

#include <span>

#include "accelerators/bvh/build/build_box.h"

namespace exphoton {

struct BvhRun {
  std::span<BvhItem> items;
  BuildBox box;
  BuildBox middles;  // of the items' boxes
};
BvhRun MakeRun(std::span<BvhItem> items);

// The items are reordered: `count` belong to the first part, at least one, fewer than all, and lie
// lower on the axis.
struct BvhSplit {
  std::size_t count = 0;
  int axis = 0;
  double cost = 0;  // half areas times blocks of triangles, of both parts; as if each were a leaf
};
// By SAH where the middles differ; otherwise in the middle of the run. At least two items.
BvhSplit SplitRun(const BvhRun& run);

// By the median of the middles along their longest extent: halves, whatever the shape.
BvhSplit HalveRun(const BvhRun& run);

// What a run costs as a leaf, in the same unit.
double LeafCost(const BvhRun& run);

}  // namespace exphoton
