// SPDX-License-Identifier: BSD-2-Clause
// PointTree stores blocks of points and a bounding volume hierarchy over them, ready for the
// searches in nearest_search.h. A block type may hold further data per point.
#pragma once

#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <vector>

#include "core/base/parallel.h"
#include "core/math/bounds.h"
#include "core/spatial/block_order.h"
#include "core/spatial/block_store.h"

namespace exphoton {

class EntryGrid;

inline constexpr std::uint32_t kBoxChildren = 16;

// The bounds of sixteen children. A node with fewer children repeats the bounds of the last child,
// as PointBlock repeats its last point.
struct alignas(64) BoxNode {
  Real low[3][kBoxChildren], high[3][kBoxChildren];

  Bounds3 Bounds() const;  // of all children
  void Set(std::uint32_t child, const Bounds3& bounds);
};

// PointBvh is an implicit 16-wide hierarchy of bounding boxes over blocks of points. Child i of
// node n is node 16 n + i of the level below, or block 16 n + i at the lowest level. It needs no
// pointers, because its shape depends only on the number of blocks.
class PointBvh {
 public:
  static constexpr int kMaxLevels = 8;
  static constexpr std::size_t kMaxPoints = std::size_t(1) << 31;

  PointBvh() = default;  // no points
  // bounds[i] is the bounding box of block i.
  explicit PointBvh(const std::vector<Bounds3>& bounds);

  int Levels() const { return int(levels_.size()); }
  const BoxNode* Level(int level) const { return levels_[level].data(); }  // 0: above the blocks
  Bounds3 Bounds() const { return levels_.empty() ? Bounds3() : levels_.back().front().Bounds(); }
  std::size_t MemoryBytes() const;

 private:
  std::vector<std::vector<BoxNode>> levels_;
};

// PointTreeView is the data that a search reads. Blocks derive from PointBlock and are contiguous.
struct PointTreeView {
  const PointBvh* tree = nullptr;
  const std::byte* blocks = nullptr;
  std::size_t blockBytes = sizeof(PointBlock);
  std::uint32_t count = 0;  // number of points
  // For each run of kSpacingPoints points: the squared radius round the middle point that is
  // expected to contain one point. Of searches, it affects the time only. May be null.
  const Real* spacing2 = nullptr;
  const EntryGrid* grid = nullptr;  // entry points of closest-disk queries; may be null

  static constexpr std::uint32_t kSpacingPoints = 64;
};

template <class Block>
class PointTree {
 public:
  using Record = typename Block::Record;
  // Memory per point: its share of a block and of the BVH. The factor 16/15 sums the nodes of all
  // levels.
  static constexpr double kBytesPerPoint =
      double(sizeof(Block)) / kBlockPoints +
      double(sizeof(BoxNode)) / (kBlockPoints * kBoxChildren) * 16 / 15;

  PointTree() = default;  // no points: searches find nothing
  // Takes the records and sorts them. Positions must be finite. Throws std::length_error above
  // PointBvh::kMaxPoints.
  PointTree(BlockStore<Block> records, ThreadPool& threads)
      : PointTree(std::move(MakeAll({&records, 1}, threads).front())) {}
  // Builds one tree per store. The trees are built together, so that threads without work in one
  // tree help with another.
  static std::vector<PointTree> MakeAll(std::span<BlockStore<Block>> stores, ThreadPool& threads) {
    std::vector<PointTree> trees(stores.size());
    std::vector<std::span<Record>> sets;
    std::vector<std::vector<Bounds3>> bounds;  // bounding boxes of the blocks
    for (std::size_t i = 0; i < stores.size(); ++i) {
      if (stores[i].Size() > PointBvh::kMaxPoints)
        throw std::length_error("too many points for one tree");
      trees[i].store_ = std::move(stores[i]);
      sets.push_back(trees[i].store_.Records());
      bounds.emplace_back((trees[i].Size() + kBlockPoints - 1) / kBlockPoints);
    }
    // Runs right after sorting, while the records are in the CPU cache.
    const auto finish = [&](std::span<Record> records, std::size_t set, std::size_t begin) {
      for (std::size_t i = 0; i < records.size(); i += kBlockPoints) {
        Bounds3 ofBlock;
        for (std::size_t k = i; k < std::min<std::size_t>(i + kBlockPoints, records.size()); ++k)
          ofBlock.Extend(records[k].p);
        bounds[set][(begin + i) / kBlockPoints] = ofBlock;
      }
      trees[set].store_.BecomeBlocks(begin, begin + records.size());
    };
    BlockOrder<Record>::Sort(sets, threads, finish);
    for (std::size_t i = 0; i < trees.size(); ++i) trees[i].tree_ = PointBvh(bounds[i]);
    return trees;
  }

  // Builds the tree of blocks that an earlier tree has sorted.
  static PointTree OfBlocks(BlockStore<Block> blocks) {
    if (blocks.Size() > PointBvh::kMaxPoints)
      throw std::length_error("too many points for one tree");
    PointTree tree;
    tree.store_ = std::move(blocks);
    std::vector<Bounds3> bounds(tree.store_.BlockCount());
    for (std::size_t i = 0; i < bounds.size(); ++i)
      for (std::uint32_t lane = 0; lane < kBlockPoints; ++lane)  // unused lanes repeat a point
        bounds[i].Extend(tree.store_.Blocks()[i].Position(lane));
    tree.tree_ = PointBvh(bounds);
    return tree;
  }
  // Gives the blocks away.
  BlockStore<Block> TakeBlocks() && { return std::move(store_); }

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
  PointBvh tree_;
};

}  // namespace exphoton
