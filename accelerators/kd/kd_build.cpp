// SPDX-License-Identifier: BSD-2-Clause
// Builder builds the kd-tree in three parallel steps. First, large cells are split level by level,
// and each chunk of their items is one task. Second, one task builds each small tree below them in
// separate arrays. Third, the small trees are copied to their final positions, in depth-first
// order.
#include "accelerators/kd/kd_build.h"

#include <memory>
#include <utility>

#include "accelerators/kd/kd_subtree.h"

namespace exphoton {
namespace {

constexpr std::size_t kTreeItems = 4096;   // most items in a cell that one task builds
constexpr std::size_t kChunkItems = 8192;  // items per task in a larger cell

// The number of item references in all leaves together is limited to
// kEntriesPerItem * items + kFreeEntries. Without this limit, a soup of large triangles, each in
// many cells, could fill any memory.
constexpr double kEntriesPerItem = 12, kFreeEntries = 1000;

// Piece is a cell and its result: a split with two further pieces, or a tree.
struct Piece {
  using Chunk = std::vector<KdItem>;

  KdCell cell;
  std::vector<Chunk> chunks;         // the items in order
  KdSplit split;                     // upper cells only
  std::size_t below = 0, above = 0;  // upper cells only: indices of the two children
  std::unique_ptr<KdSubtree> tree;   // all other cells

  std::size_t Items() const {
    std::size_t count = 0;
    for (const Chunk& chunk : chunks) count += chunk.size();
    return count;
  }
  // Moves all items into one chunk and frees the others.
  Chunk Joined() {
    if (chunks.size() == 1) return std::move(chunks[0]);
    Chunk items;
    items.reserve(Items());
    for (Chunk& chunk : chunks) {
      items.insert(items.end(), chunk.begin(), chunk.end());
      chunk = {};
    }
    return items;
  }
};

class Builder {
 public:
  Builder(const PrimitiveSet& primitives, const KdCosts& costs, ThreadPool& threads)
      : primitives_(primitives), costs_(costs), threads_(threads) {}

  KdArrays Build() && {
    Piece root = Root();
    const std::size_t items = root.Items();
    if (items == 0) return {};
    arrays_.bounds = root.cell.bounds;
    const double budget = kEntriesPerItem * double(items) + kFreeEntries;
    root.cell.limits = {costs_.maxDepth, 0, budget};
    pieces_.push_back(std::move(root));
    for (std::size_t level = 0; level < pieces_.size();) level = SplitLevel(level);
    MakeTrees();
    Place(0);
    threads_.For(std::int64_t(trees_.size()), [&](std::int64_t i, int) {
      Piece& piece = pieces_[trees_[std::size_t(i)]];
      piece.tree->CopyTo(&arrays_);
      piece.tree.reset();
    });
    return std::move(arrays_);
  }

 private:
  Piece Root() {
    const std::size_t count = primitives_.Count();
    Piece root;
    root.chunks.resize((count + kChunkItems - 1) / kChunkItems);
    std::vector<Bounds3> bounds(root.chunks.size());
    threads_.For(std::int64_t(root.chunks.size()), [&](std::int64_t i, int) {
      Piece::Chunk items;
      const std::size_t begin = std::size_t(i) * kChunkItems;
      const std::size_t end = std::min(begin + kChunkItems, count);
      items.reserve(end - begin);
      for (std::size_t id = begin; id < end; ++id) {
        const Bounds3 own = primitives_.Bounds(std::uint32_t(id));
        if (own.IsEmpty()) continue;  // an empty instance
        items.push_back({std::uint32_t(id), KdItemBounds(own)});
        bounds[std::size_t(i)].Extend(items.back().bounds);
      }
      root.chunks[std::size_t(i)] = std::move(items);
    });
    for (const Bounds3& ofChunk : bounds) root.cell.bounds.Extend(ofChunk);
    return root;
  }

  // Task is one chunk of a cell to be split, with its bins and its parts.
  struct Task {
    std::size_t piece, chunk;
    KdBins bins;
    Piece::Chunk below, above;
  };
  // The tasks of one cell are adjacent.
  using Tasks = std::span<Task>;

  // Splits the large cells from index `begin` on. Returns the index of the next level's first cell.
  std::size_t SplitLevel(std::size_t begin) {
    const std::size_t end = pieces_.size();
    threads_.For(std::int64_t(end - begin), [&](std::int64_t i, int) {
      Piece& piece = pieces_[begin + std::size_t(i)];
      if (piece.chunks.size() == 1 || piece.Items() > kChunkItems) return;
      Piece::Chunk joined = piece.Joined();
      piece.chunks.clear();
      piece.chunks.push_back(std::move(joined));
    });
    std::vector<Task> tasks;
    for (std::size_t i = begin; i < end; ++i) {
      Piece& piece = pieces_[i];
      const std::size_t items = piece.Items();
      if (items <= kTreeItems || !piece.cell.IsSplittable(items, costs_)) continue;
      for (std::size_t chunk = 0; chunk < piece.chunks.size(); ++chunk)
        tasks.push_back({i, chunk, KdBins(piece.cell.bounds), {}, {}});
    }
    FindSplits(tasks);
    threads_.For(std::int64_t(tasks.size()), [&](std::int64_t i, int) {
      Task& task = tasks[std::size_t(i)];
      const Piece& piece = pieces_[task.piece];
      if (piece.split.axis < 0) return;
      PartKdItems(primitives_, piece.chunks[task.chunk], KdCut(piece.cell, piece.split),
                  &task.below, &task.above);
    });
    ForEachPiece(tasks, [&](Tasks ofPiece) { AddParts(ofPiece); });
    for (std::size_t i = begin; i < end; ++i)
      if (pieces_[i].below == 0) trees_.push_back(i);
    return end;
  }

  template <class Function>
  static void ForEachPiece(Tasks tasks, const Function& function) {
    while (!tasks.empty()) {
      std::size_t count = 1;
      while (count < tasks.size() && tasks[count].piece == tasks[0].piece) ++count;
      function(tasks.first(count));
      tasks = tasks.subspan(count);
    }
  }

  void FindSplits(Tasks tasks) {
    threads_.For(std::int64_t(tasks.size()), [&](std::int64_t i, int) {
      Task& task = tasks[std::size_t(i)];
      task.bins.Add(pieces_[task.piece].chunks[task.chunk]);
    });
    ForEachPiece(tasks, [&](Tasks ofPiece) {
      for (const Task& other : ofPiece.subspan(1)) ofPiece[0].bins.Add(other.bins);
      Piece& piece = pieces_[ofPiece[0].piece];
      const KdSplit split = FindKdSplit(ofPiece[0].bins, piece.cell.bounds, costs_);
      if (piece.cell.Accepts(split, piece.Items(), costs_)) piece.split = split;
    });
  }

  // Adds the two parts of a cell as new pieces, unless the cell is to stay whole.
  void AddParts(Tasks tasks) {
    const std::size_t index = tasks[0].piece;
    if (pieces_[index].split.axis < 0) return;
    KdCut cut(pieces_[index].cell, pieces_[index].split);
    Piece below, above;
    for (Task& task : tasks) {
      below.chunks.push_back(std::move(task.below));
      above.chunks.push_back(std::move(task.above));
    }
    if (!cut.Share(pieces_[index].Items(), below.Items(), above.Items())) return;
    below.cell = cut.below, above.cell = cut.above;
    pieces_[index].chunks = {};
    pieces_[index].below = pieces_.size(), pieces_[index].above = pieces_.size() + 1;
    pieces_.push_back(std::move(below));
    pieces_.push_back(std::move(above));
  }

  void MakeTrees() {
    threads_.For(std::int64_t(trees_.size()), [&](std::int64_t i, int) {
      Piece& piece = pieces_[trees_[std::size_t(i)]];
      piece.tree = std::make_unique<KdSubtree>(primitives_, costs_);
      Piece::Chunk items = piece.Joined();
      if (items.size() > kTreeItems) {
        piece.tree->Leaf(items);  // a large cell that is not to be split
      } else {
        piece.tree->Cell(std::move(items), piece.cell);
      }
    });
    std::size_t nodes = pieces_.size(), blocks = 0;
    for (const std::size_t i : trees_) {
      nodes += pieces_[i].tree->Nodes();
      blocks += pieces_[i].tree->Blocks();
    }
    arrays_.nodes.reserve(nodes - trees_.size());
    arrays_.blocks.reserve(blocks);
  }

  // Assigns positions to a piece and to everything below it, and creates the upper nodes.
  void Place(std::size_t index) {
    const Piece& piece = pieces_[index];
    if (piece.tree) return piece.tree->Place(&arrays_);
    const std::size_t node = arrays_.nodes.size();
    arrays_.nodes.emplace_back();
    Place(piece.below);
    const auto above = std::uint32_t(arrays_.nodes.size());
    Place(piece.above);
    arrays_.nodes[node] = KdNode::Inner(piece.split.axis, piece.split.position, above);
  }

  const PrimitiveSet& primitives_;
  const KdCosts costs_;
  ThreadPool& threads_;
  std::vector<Piece> pieces_;       // level by level
  std::vector<std::size_t> trees_;  // indices of the pieces that are not upper cells
  KdArrays arrays_;
};

}  // namespace

KdArrays BuildKdTree(const PrimitiveSet& primitives, const KdCosts& costs, ThreadPool& threads) {
  return Builder(primitives, costs, threads).Build();
}

}  // namespace exphoton
