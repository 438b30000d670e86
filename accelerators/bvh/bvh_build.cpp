// SPDX-License-Identifier: BSD-2-Clause
// In three steps, each of pieces that threads take: the upper nodes are planned level by level;
// the small trees below them are made, each in arrays of its own; these are copied behind the upper
// nodes, in the order of a walk, where what they refer to gets its place among all lines.
#include "accelerators/bvh/bvh_build.h"

#include <cstring>

#include "accelerators/bvh/bvh_subtree.h"

namespace exphoton {
namespace {

constexpr std::size_t kTreeItems = 4096;     // of a run that is one piece of work
constexpr std::uint32_t kChunkItems = 8192;  // primitives whose bounds are one piece of work

// Larger by at least the margin on every side, and by one step of Real where that is more. Finite:
// nothing is ever hit beyond.
Bounds3 Grown(const Bounds3& bounds) {
  constexpr Real kLargest = std::numeric_limits<Real>::max();
  const Real margin = kBvhMargin * MaxComponent(bounds.Diagonal());
  Bounds3 grown = bounds;
  for (int axis = 0; axis < 3; ++axis) {
    grown.min[axis] = std::max(NextDown(bounds.min[axis] - margin), -kLargest);
    grown.max[axis] = std::min(NextUp(bounds.max[axis] + margin), kLargest);
  }
  return grown;
}

std::vector<BvhItem> MakeItems(const PrimitiveSet& primitives, ThreadPool& threads) {
  const std::uint32_t count = primitives.Count();
  std::vector<BvhItem> items(count);
  threads.For((count + kChunkItems - 1) / kChunkItems, [&](std::int64_t chunk, int) {
    const auto begin = std::uint32_t(chunk) * kChunkItems;
    for (std::uint32_t id = begin; id < std::min(begin + kChunkItems, count); ++id) {
      const Bounds3 bounds = primitives.Bounds(id);
      items[id] = bounds.IsEmpty() ? BvhItem({}, kNoId) : BvhItem(Grown(bounds), id);
    }
  });
  std::erase_if(items, [](const BvhItem& item) { return item.id == kNoId; });  // of nothing
  return items;
}

// A run, and what becomes of it.
struct Piece {
  BvhRun run;
  int depth = 1;
  BvhParts parts;                                 // of an upper node: and
  std::array<std::size_t, kBvhWidth> children{};  // the pieces of those that are no leaves
  std::unique_ptr<BvhSubtree> tree;               // of a piece of work: its arrays, and
  BvhMade made;                                   // its first node in them
  std::uint32_t firstLine = 0, firstOther = 0;    // where they are copied to

  bool IsUpper() const { return run.items.size() > kTreeItems; }
};

class Builder {
 public:
  Builder(const PrimitiveSet& primitives, std::uint32_t maxLeafTriangles, ThreadPool& threads)
      : primitives_(primitives),
        maxLeafTriangles_(maxLeafTriangles),
        threads_(threads),
        upper_(primitives, maxLeafTriangles) {}

  BvhArrays Build() && {
    std::vector<BvhItem> items = MakeItems(primitives_, threads_);
    if (items.empty()) return {};
    pieces_.emplace_back().run = MakeRun(items);
    for (std::size_t level = 0; level < pieces_.size();) level = PlanLevel(level);
    MakeTrees();
    Place(0);
    BvhArrays& arrays = upper_.Arrays();
    arrays.bounds = pieces_[0].run.box.ToBounds();
    threads_.For(std::int64_t(trees_.size()),
                 [&](std::int64_t i, int) { CopyTree(&pieces_[trees_[std::size_t(i)]]); });
    return std::move(arrays);
  }

 private:
  // Splits all pieces from `begin` on; returns where those of the next level begin.
  std::size_t PlanLevel(std::size_t begin) {
    const std::size_t end = pieces_.size();
    threads_.For(std::int64_t(end - begin), [&](std::int64_t i, int) {
      Piece& piece = pieces_[begin + std::size_t(i)];
      if (piece.IsUpper()) piece.parts = upper_.SplitIntoParts(piece.run, piece.depth);
    });
    for (std::size_t i = begin; i < end; ++i) {
      if (!pieces_[i].IsUpper()) {
        trees_.push_back(i);
        continue;
      }
      for (int part = 0; part < pieces_[i].parts.count; ++part) {
        if (pieces_[i].parts.isLeaf[part]) continue;
        pieces_[i].children[part] = pieces_.size();
        Piece& child = pieces_.emplace_back();
        child.run = pieces_[i].parts.runs[part];
        child.depth = pieces_[i].depth + 1;
      }
    }
    return end;
  }

  void MakeTrees() {
    threads_.For(std::int64_t(trees_.size()), [&](std::int64_t i, int) {
      Piece& piece = pieces_[trees_[std::size_t(i)]];
      piece.tree = std::make_unique<BvhSubtree>(primitives_, maxLeafTriangles_);
      piece.tree->Arrays().lines.reserve(piece.run.items.size() + kBvhNodeLines);
      piece.made = piece.tree->Tree(piece.run, piece.depth);
    });
    std::size_t lines = 0;
    for (const std::size_t i : trees_) lines += pieces_[i].tree->Arrays().lines.size();
    upper_.Arrays().lines.reserve(lines + pieces_.size() * kBvhNodeLines);
  }

  // Gives a piece and all below it their places, and makes the upper nodes.
  BvhMade Place(std::size_t index) {
    Piece& piece = pieces_[index];
    if (piece.IsUpper())
      return upper_.Node(piece.run, piece.parts, piece.depth,
                         [&](int part) { return Place(piece.children[part]); });
    BvhArrays& all = upper_.Arrays();
    const BvhArrays& own = piece.tree->Arrays();
    all.depth = std::max(all.depth, own.depth);
    piece.firstLine = upper_.NewLines(std::uint32_t(own.lines.size()));
    piece.firstOther = std::uint32_t(all.others.size());
    all.others.insert(all.others.end(), own.others.begin(), own.others.end());
    return {Moved(piece.made.child, piece), piece.made.blocking};
  }

  static BvhChild Moved(BvhChild child, const Piece& piece) {
    const bool isOther = child.GetKind() == BvhChild::Kind::Others;
    return BvhChild(child.GetKind(),
                    child.Index() + (isOther ? piece.firstOther : piece.firstLine));
  }

  void CopyTree(Piece* piece) {
    BvhLine* const first = upper_.Arrays().lines.data() + piece->firstLine;
    const auto& own = piece->tree->Arrays().lines;
    std::memcpy(first, own.data(), own.size() * sizeof(BvhLine));
    MoveChildren(first, piece->made.child, *piece);
    piece->tree.reset();
  }
  static void MoveChildren(BvhLine* first, BvhChild child, const Piece& piece) {
    auto& node = *reinterpret_cast<BvhNode*>(first + child.Index());
    for (int i = 0; i < kBvhWidth && node.rows[0][i] <= node.rows[1][i]; ++i) {
      if (node.children[i].IsNode()) MoveChildren(first, node.children[i], piece);
      node.children[i] = Moved(node.children[i], piece);
    }
  }

  const PrimitiveSet& primitives_;
  const std::uint32_t maxLeafTriangles_;
  ThreadPool& threads_;
  std::vector<Piece> pieces_;       // level by level
  std::vector<std::size_t> trees_;  // those that are no upper nodes
  BvhSubtree upper_;
};

}  // namespace

BvhArrays BuildBvh(const PrimitiveSet& primitives, std::uint32_t maxLeafTriangles,
                   ThreadPool& threads) {
  const std::uint32_t most = std::min(maxLeafTriangles, std::uint32_t(kBvhWidth));
  return Builder(primitives, most, threads).Build();
}

}  // namespace exphoton
