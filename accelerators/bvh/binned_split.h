// SPDX-License-Identifier: BSD-2-Clause
// Splitting a run of primitives in two by the surface area heuristic over 32 bins an axis.
// Source: Wald 2007, "On fast Construction of SAH-based Bounding Volume Hierarchies".
#pragma once

#include <cstdint>
#include <span>

#include "core/math/bounds.h"

namespace exphoton {

struct BvhItem {
  Bounds3 bounds;  // with margins
  std::uint32_t id;

  // The middle; halves first, so that it never overflows.
  Real Centroid(int axis) const {
    return bounds.min[axis] * Real(.5) + bounds.max[axis] * Real(.5);
  }
};

struct BvhRun {
  std::span<BvhItem> items;
  Bounds3 bounds;
  Bounds3 centroids;  // of the items' middles
};
BvhRun MakeRun(std::span<BvhItem> items);

// Half the surface of a box in double: what no finite box overflows.
double HalfArea(const Bounds3& bounds);

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
