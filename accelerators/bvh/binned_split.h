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

// Reorders the items and returns how many belong to the first part: at least one, fewer than all.
// By SAH where the middles differ; otherwise in the middle of the run. At least two items.
std::size_t SplitRun(const BvhRun& run);

// The same by the median of the middles along their longest extent: halves, whatever the shape.
std::size_t HalveRun(const BvhRun& run);

}  // namespace exphoton
