// SPDX-License-Identifier: BSD-2-Clause
// One thread's work at a kd-tree: the tree of one cell, in arrays of its own, and copying it to its
// place in the whole.
#pragma once

#include "accelerators/kd/kd_cell.h"

namespace exphoton {

class KdSubtree {
 public:
  KdSubtree(const PrimitiveSet& primitives, const KdCosts& costs)
      : primitives_(primitives), costs_(costs) {}

  // One cell after the other, below before above, so that a child below its plane follows its
  // parent.
  void Cell(std::vector<KdItem> items, KdCell cell);
  void Leaf(std::span<const KdItem> items);

  std::size_t Nodes() const { return nodes_.size(); }
  std::size_t Blocks() const { return ids_.size() / kBvhWidth; }
  // Takes room behind what the arrays have.
  void Place(KdArrays* arrays);
  // Once all have their places and the arrays their size.
  void CopyTo(KdArrays* arrays) const;

 private:
  std::uint32_t NewNode();

  const PrimitiveSet& primitives_;
  const KdCosts& costs_;
  std::vector<KdNode> nodes_;       // leaves count their blocks from 0
  std::vector<std::uint32_t> ids_;  // of the triangles of blocks, kBvhWidth each; kNoId behind
  std::vector<std::uint32_t> entries_;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> others_;  // node, entry
  std::size_t firstNode_ = 0, firstBlock_ = 0;                   // places
};

}  // namespace exphoton
