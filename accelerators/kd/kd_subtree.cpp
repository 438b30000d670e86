// SPDX-License-Identifier: BSD-2-Clause
#include "accelerators/kd/kd_subtree.h"

#include <algorithm>

#include "core/base/error.h"

namespace exphoton {
namespace {

constexpr std::size_t kMostNodes = std::size_t(1) << 30, kMostBlocks = std::size_t(1) << 32;
constexpr std::size_t kMostLeafBlocks = std::size_t(1) << 29;

void CheckNodes(std::size_t count) {
  if (count > kMostNodes) throw Error(ExitStatus::Resource, "the kd-tree has more than 2^30 nodes");
}
void CheckBlocks(std::size_t count, std::size_t ofLeaf = 0) {
  if (ofLeaf >= kMostLeafBlocks || count >= kMostBlocks)
    throw Error(ExitStatus::Resource, "the kd-tree has more than 2^32 blocks of triangles");
}
void CheckEntries(std::size_t count) {
  if (count >= kMostBlocks)
    throw Error(ExitStatus::Resource, "the kd-tree has more than 2^32 entries");
}

}  // namespace

void KdSubtree::Cell(std::vector<KdItem> items, KdCell cell) {
  if (!cell.IsSplittable(items.size(), costs_)) return Leaf(items);
  const KdSplit split = FindKdSplit(items, cell.bounds, costs_);
  if (!cell.Accepts(split, items.size(), costs_)) return Leaf(items);
  KdCut cut(cell, split);
  std::vector<KdItem> below, above;
  PartKdItems(primitives_, items, cut, &below, &above);
  if (!cut.Share(items.size(), below.size(), above.size())) return Leaf(items);
  items = {};
  const std::uint32_t index = NewNode();
  Cell(std::move(below), cut.below);
  const auto aboveIndex = std::uint32_t(nodes_.size());
  Cell(std::move(above), cut.above);
  nodes_[index] = KdNode::Inner(split.axis, split.position, aboveIndex);
}

std::uint32_t KdSubtree::NewNode() {
  CheckNodes(nodes_.size() + 1);
  nodes_.push_back({});
  return std::uint32_t(nodes_.size() - 1);
}

void KdSubtree::Leaf(std::span<const KdItem> items) {
  const std::uint32_t index = NewNode();
  const std::size_t first = ids_.size(), firstEntry = entries_.size();
  for (const KdItem& item : items) {
    const bool isTriangle = item.id < primitives_.TriangleCount();
    (isTriangle ? ids_ : entries_).push_back(item.id);
  }
  while (ids_.size() % kBvhWidth != 0) ids_.push_back(kNoId);
  const std::size_t blocks = (ids_.size() - first) / kBvhWidth;
  CheckBlocks(ids_.size() / kBvhWidth, blocks);
  const auto others = std::uint32_t(entries_.size() - firstEntry);
  nodes_[index] = KdNode::Leaf(std::uint32_t(first / kBvhWidth), std::uint32_t(blocks), others > 0);
  if (others == 0) return;
  CheckEntries(entries_.size() + 1);
  others_.emplace_back(index, std::uint32_t(firstEntry));
  entries_.insert(entries_.begin() + std::ptrdiff_t(firstEntry), others);
}

void KdSubtree::Place(KdArrays* arrays) {
  firstNode_ = arrays->nodes.size(), firstBlock_ = arrays->blocks.size();
  const std::size_t firstEntry = arrays->entries.size();
  CheckNodes(firstNode_ + nodes_.size());
  CheckBlocks(firstBlock_ + ids_.size() / kBvhWidth);
  CheckEntries(firstEntry + entries_.size());
  arrays->nodes.resize(firstNode_ + nodes_.size());
  arrays->blocks.resize(firstBlock_ + ids_.size() / kBvhWidth);
  arrays->entries.insert(arrays->entries.end(), entries_.begin(), entries_.end());
  for (const auto& [node, entry] : others_)
    arrays->others[std::uint32_t(firstNode_ + node)] = std::uint32_t(firstEntry + entry);
}

void KdSubtree::CopyTo(KdArrays* arrays) const {
  KdNode* const nodes = arrays->nodes.data() + firstNode_;
  for (std::size_t i = 0; i < nodes_.size(); ++i)
    nodes[i] = nodes_[i].Moved(std::uint32_t(firstNode_), std::uint32_t(firstBlock_));
  for (std::size_t i = 0; i < ids_.size(); i += kBvhWidth) {
    const auto ids = std::span(ids_).subspan(i, kBvhWidth);
    const auto end = std::find(ids.begin(), ids.end(), kNoId);
    arrays->blocks[firstBlock_ + i / kBvhWidth] =
        MakeBlock(primitives_, ids.first(std::size_t(end - ids.begin())));
  }
}

}  // namespace exphoton
