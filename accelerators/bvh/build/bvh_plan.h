// SPDX-License-Identifier: BSD-2-Clause
// PlanBvh builds the plan of a BVH: a binary tree over runs of items, and the choice of its nodes
// that become 8-wide nodes. The plan depends on the items alone, not on the number of threads.
#pragma once

#include "accelerators/bvh/build/binned_split.h"
#include "accelerators/bvh/build/collapse.h"
#include "core/base/parallel.h"

namespace exphoton {

struct BvhPlanNode {
  Bounds3 bounds;
  std::uint32_t first = 0, count = 0;  // the node's run of items
  // Index offsets from this node to its two halves; 0 for a leaf of the binary tree.
  std::uint32_t lower = 0, upper = 0;
  ForestShares shares;
  std::uint8_t axis = 0;  // the lower half lies lower on this axis
  // What the node becomes if it takes one slot of an 8-wide node: a leaf of the 8-wide BVH, or
  // itself an 8-wide node. A node with halves can become a leaf, too.
  bool isLeaf = false;
};

// Nodes below this depth halve their runs, which adds at most 32 levels.
inline constexpr int kBvhSahDepth = kBvhMaxDepth - 32;

// The root comes first. PlanBvh reorders the items and needs at least one. No path from the root
// has more than sahDepth + 32 nodes with halves.
std::vector<BvhPlanNode> PlanBvh(const PrimitiveSet& primitives, std::uint32_t maxLeafTriangles,
                                 std::span<BvhItem> items, ThreadPool& threads,
                                 int sahDepth = kBvhSahDepth);

// One task plans a whole run with at most this number of items.
inline constexpr std::size_t kBvhPieceItems = 4096;

}  // namespace exphoton
