// SPDX-License-Identifier: BSD-2-Clause
// PointTree: points in blocks, with whatever else the kind of block holds, under a tree of boxes:
// ready to be searched.
#pragma once

#include <stdexcept>

#include "core/spatial/block_order.h"
#include "core/spatial/block_store.h"
#include "core/spatial/nearest_search.h"

namespace exphoton {

template <class Block>
class PointTree {
 public:
  using Record = typename Block::Record;
  // Memory for each point beside its record: boxes, a sixteenth more for those above.
  static constexpr double kBytesPerPoint =
      double(sizeof(Block)) / kBlockPoints +
      double(sizeof(BoxNode)) / (kBlockPoints * kBoxChildren) * 16 / 15;

  PointTree() = default;  // no points: nothing is near
  // Takes the records, whose positions must be finite, and sorts them. Throws std::length_error
  // above BoxTree::kMaxPoints.
  PointTree(BlockStore<Block> records, ThreadPool& threads) : store_(std::move(records)) {
    if (Size() > BoxTree::kMaxPoints) throw std::length_error("too many points for one tree");
    const std::span<Record> sorted = store_.Records();
    BlockOrder<Record>::Sort(sorted, threads);
    std::vector<Bounds3> bounds((Size() + kBlockPoints - 1) / kBlockPoints);
    for (std::size_t i = 0; i < Size(); ++i) bounds[i / kBlockPoints].Extend(sorted[i].p);
    tree_ = BoxTree(bounds);
    store_.BecomeBlocks();
  }

  std::size_t Size() const { return store_.Size(); }
  const Block& BlockOf(std::uint32_t i) const { return store_.Blocks()[i / kBlockPoints]; }
  static std::uint32_t Lane(std::uint32_t i) { return i % kBlockPoints; }
  Point3 Position(std::uint32_t i) const { return BlockOf(i).Position(Lane(i)); }
  Vector3 Direction(std::uint32_t i) const { return BlockOf(i).Direction(Lane(i)); }
  Bounds3 Bounds() const { return tree_.Bounds(); }
  std::size_t MemoryBytes() const { return store_.MemoryBytes() + tree_.MemoryBytes(); }

  PointTreeView View() const {
    return {&tree_, reinterpret_cast<const std::byte*>(store_.Blocks()), sizeof(Block),
            std::uint32_t(Size()), nullptr};
  }

 private:
  BlockStore<Block> store_;
  BoxTree tree_;
};

}  // namespace exphoton
