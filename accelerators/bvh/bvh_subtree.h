// SPDX-License-Identifier: BSD-2-Clause
// One thread's work at a hierarchy: the tree below one node, in arrays of its own. Top-down: a node
// starts with one run of primitives as its child, and splits the child of the largest surface until
// there are eight.
#pragma once

#include "accelerators/bvh/binned_split.h"
#include "accelerators/bvh/bvh_layout.h"
#include "accelerators/bvh/child_order.h"

namespace exphoton {

// The parts that a node's run has been split into: its children.
struct BvhParts {
  std::array<BvhRun, kBvhWidth> runs;
  std::array<bool, kBvhWidth> isLeaf{};  // of others there is a node
  int count = 1;
  NearOrders orders;
};

struct BvhMade {
  BvhChild child;
  Blocking blocking;
};

class BvhSubtree {
 public:
  BvhSubtree(const PrimitiveSet& primitives, std::uint32_t maxLeafTriangles)
      : primitives_(primitives), maxLeafTriangles_(maxLeafTriangles) {
    arrays_.others.push_back(0);  // the list of none
  }

  // Reorders the items of the run.
  BvhParts SplitIntoParts(const BvhRun& whole, int depth) const;

  // Adds a node. makeNode(part) makes the child of each part that is no leaf.
  template <class MakeNode>
  BvhMade Node(const BvhRun& whole, const BvhParts& parts, int depth, const MakeNode& makeNode);
  // Adds a node and all below it.
  BvhMade Tree(const BvhRun& whole, int depth);

  std::uint32_t NewLines(std::uint32_t count);
  const BvhArrays& Arrays() const { return arrays_; }
  BvhArrays& Arrays() { return arrays_; }

 private:
  bool IsTriangle(const BvhItem& item) const { return item.id < primitives_.TriangleCount(); }
  bool CanBeLeaf(const BvhRun& run) const;
  BvhSplit Split(const BvhRun& run, int depth) const;
  BvhMade Leaf(const BvhRun& run);
  void CheckDepth(int depth);
  BvhMade Write(std::uint32_t line, const BvhRun& whole, const BvhParts& parts,
                std::span<const BvhMade> made);

  const PrimitiveSet& primitives_;
  std::uint32_t maxLeafTriangles_;
  BvhArrays arrays_;
};

template <class MakeNode>
BvhMade BvhSubtree::Node(const BvhRun& whole, const BvhParts& parts, int depth,
                         const MakeNode& makeNode) {
  CheckDepth(depth);
  const std::uint32_t line = NewLines(kBvhNodeLines);
  std::array<BvhMade, kBvhWidth> made;
  // Leaves first: close to their node.
  for (int i = 0; i < parts.count; ++i)
    if (parts.isLeaf[i]) made[i] = Leaf(parts.runs[i]);
  for (int i = 0; i < parts.count; ++i)
    if (!parts.isLeaf[i]) made[i] = makeNode(i);
  return Write(line, whole, parts, std::span(made).first(std::size_t(parts.count)));
}

}  // namespace exphoton
