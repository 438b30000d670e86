// SPDX-License-Identifier: BSD-2-Clause
// The plan of a hierarchy: a binary tree over runs of items, and which of its nodes become nodes of
// eight. It depends on the items alone, not on the threads.
#pragma once

#include "accelerators/bvh/build/binned_split.h"
#include "accelerators/bvh/build/collapse.h"
#include "core/base/parallel.h"

namespace exphoton {

struct BvhPlanNode {
  Bounds3 bounds;
  std::uint32_t first = 0, count = 0;  // its run of items
  // Its halves, as distances from itself in the plan; of a leaf 0.
  std::uint32_t lower = 0, upper = 0;
  ForestShares shares;
  std::uint8_t axis = 0;  // along which the lower half lies below
  bool isLeaf = false;    // where it is a single child of a node
};

// Deeper nodes halve their runs: at most 32 levels more.
inline constexpr int kBvhSahDepth = kBvhMaxDepth - 32;

// The root is the first. Reorders the items, of which there is one at least. No way down has more
// than sahDepth + 32 nodes with halves.
std::vector<BvhPlanNode> PlanBvh(const PrimitiveSet& primitives, std::uint32_t maxLeafTriangles,
                                 std::span<BvhItem> items, ThreadPool& threads,
                                 int sahDepth = kBvhSahDepth);

// Runs of so many items and fewer are one piece of work.
inline constexpr std::size_t kBvhPieceItems = 4096;

}  // namespace exphoton
