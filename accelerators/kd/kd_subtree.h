// SPDX-License-Identifier: BSD-2-Clause
// KdSubtree is one thread's task in building a kd-tree. It builds the tree of one cell in private
// arrays and copies them to their place in the whole tree.
#pragma once

#include "accelerators/kd/kd_cell.h"

namespace exphoton {

class KdSubtree {
 public:
  KdSubtree(const PrimitiveSet& primitives, const KdCosts& costs)
      : primitives_(primitives), costs_(costs) {}

  // Builds a cell and everything below it in depth-first order. The child below a plane comes
  // first, so that it follows its parent directly.
  void Cell(std::vector<KdItem> items, KdCell cell);
  void Leaf(std::span<const KdItem> items);

  std::size_t Nodes() const { return nodes_.size(); }
  std::size_t Blocks() const { return ids_.size() / kBvhWidth; }
  // Reserves space for this tree at the end of the arrays.
  void Place(KdArrays* arrays);
  // Copies nodes and blocks to the reserved space. Call this after all trees have called Place.
  void CopyTo(KdArrays* arrays) const;

 private:
  std::uint32_t NewNode();

  const PrimitiveSet& primitives_;
  const KdCosts& costs_;
  std::vector<KdNode> nodes_;       // indices of blocks start at 0
  std::vector<std::uint32_t> ids_;  // triangles, kBvhWidth per block, padded with kNoId
  std::vector<std::uint32_t> entries_;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> others_;  // node index, index into entries_
  std::size_t firstNode_ = 0, firstBlock_ = 0;                   // positions in the whole tree
};

}  // namespace exphoton
