// SPDX-License-Identifier: BSD-2-Clause
// Planner splits upper nodes level by level, and all threads share each level. One thread plans
// each small tree below them. The small trees are then appended behind the upper nodes.
#include "accelerators/bvh/build/bvh_plan.h"

#include <algorithm>

namespace exphoton {
namespace {

constexpr std::size_t kMaxLeafOthers = 2;
// A run that can be a leaf is split only if the leaf costs more than this factor times the split.
// Two leaves take more memory than one, and waiting for memory is a large part of the work.
constexpr double kLeafPreference = 1.25;

// Splitter chooses how to split a run, independently of the run's position in the plan.
class Splitter {
 public:
  Splitter(const PrimitiveSet& primitives, std::uint32_t maxLeafTriangles, int sahDepth)
      : triangles_(primitives.TriangleCount()),
        maxLeafTriangles_(maxLeafTriangles),
        sahDepth_(sahDepth) {}

  // Returns whether the items are few enough for a leaf and all of one kind.
  bool CanBeLeaf(const BvhRun& run) const {
    const std::size_t count = run.items.size();
    if (count == 1) return true;
    if (count > std::max(std::size_t(maxLeafTriangles_), kMaxLeafOthers)) return false;
    const bool isTriangle = IsTriangle(run.items[0]);
    for (const BvhItem& item : run.items)
      if (IsTriangle(item) != isTriangle) return false;
    return count <= (isTriangle ? maxLeafTriangles_ : kMaxLeafOthers);
  }

  // The run needs at least two items.
  BvhSplit Split(const BvhRun& run, int depth) const {
    if (run.items.size() <= maxLeafTriangles_) {  // separates triangles from others, if it has both
      const auto middle = std::partition(run.items.begin(), run.items.end(),
                                         [this](const BvhItem& item) { return IsTriangle(item); });
      const std::size_t triangles = std::size_t(middle - run.items.begin());
      if (triangles > 0 && triangles < run.items.size())
        return {triangles, 0, std::numeric_limits<double>::infinity()};
    }
    return depth > sahDepth_ ? HalveRun(run) : SplitRun(run);
  }

 private:
  bool IsTriangle(const BvhItem& item) const { return item.id < triangles_; }

  std::uint32_t triangles_, maxLeafTriangles_;
  int sahDepth_;
};

struct Halves {
  BvhRun lower, upper;
  std::uint8_t axis = 0;
};
Halves Part(const BvhRun& run, const BvhSplit& split) {
  return {MakeRun(run.items.first(split.count)), MakeRun(run.items.subspan(split.count)),
          std::uint8_t(split.axis)};
}

BvhPlanNode NodeOf(const BvhRun& run, std::uint32_t first) {
  BvhPlanNode node;
  node.bounds = run.box.ToBounds();
  node.first = first, node.count = std::uint32_t(run.items.size());
  return node;
}

void SetCollapse(const Collapse& collapse, BvhPlanNode* node) {
  node->shares = collapse.shares, node->isLeaf = collapse.isLeaf;
}

// Plans a small tree in depth-first order, so the lower half of a node directly follows it.
ForestCost PlanTree(const Splitter& splitter, const BvhRun& run, std::uint32_t first, int depth,
                    std::vector<BvhPlanNode>* plan) {
  const std::size_t own = plan->size();
  plan->push_back(NodeOf(run, first));
  const double area = HalfArea(run.box);
  const bool canBeLeaf = splitter.CanBeLeaf(run);
  Collapse collapse;
  const BvhSplit split = run.items.size() > 1 ? splitter.Split(run, depth) : BvhSplit{};
  if (split.count == 0 || (canBeLeaf && LeafCost(run) <= kLeafPreference * split.cost)) {
    collapse = CollapseLeaf(area);
  } else {
    const Halves halves = Part(run, split);
    const ForestCost lower = PlanTree(splitter, halves.lower, first, depth + 1, plan);
    BvhPlanNode& node = (*plan)[own];
    node.lower = 1, node.upper = std::uint32_t(plan->size() - own), node.axis = halves.axis;
    const ForestCost upper =
        PlanTree(splitter, halves.upper, first + std::uint32_t(split.count), depth + 1, plan);
    collapse = CollapseHalves(area, canBeLeaf, lower, upper);
  }
  SetCollapse(collapse, &(*plan)[own]);
  return collapse.least;
}

class Planner {
 public:
  Planner(const Splitter& splitter, ThreadPool& threads) : splitter_(splitter), threads_(threads) {}

  std::vector<BvhPlanNode> Plan(std::span<BvhItem> items) && {
    Add(MakeRun(items), 0);
    std::size_t level = 0;
    for (int depth = 1; level < plan_.size(); ++depth) level = SplitLevel(level, depth);
    PlanPieces();
    CollapseUpper();
    AppendPieces();
    return std::move(plan_);
  }

 private:
  // Piece is a run whose tree is planned as one task.
  struct Piece {
    std::size_t node = 0;
    int depth = 0;
    std::vector<BvhPlanNode> plan;
  };

  void Add(const BvhRun& run, std::uint32_t first) {
    plan_.push_back(NodeOf(run, first));
    runs_.push_back(run);
  }

  // Splits the nodes from index `begin` on. Returns the index of the next level's first node.
  std::size_t SplitLevel(std::size_t begin, int depth) {
    const std::size_t end = plan_.size();
    std::vector<Halves> halves(end - begin);
    threads_.For(std::int64_t(end - begin), [&](std::int64_t i, int) {
      const BvhRun& run = runs_[begin + std::size_t(i)];
      if (run.items.size() > kBvhPieceItems)
        halves[std::size_t(i)] = Part(run, splitter_.Split(run, depth));
    });
    for (std::size_t i = begin; i < end; ++i) {
      const Halves& parts = halves[i - begin];
      if (parts.lower.items.empty()) {
        pieces_.push_back({i, depth, {}});
        continue;
      }
      plan_[i].axis = parts.axis;
      plan_[i].lower = std::uint32_t(plan_.size() - i), plan_[i].upper = plan_[i].lower + 1;
      const std::uint32_t first = plan_[i].first;
      Add(parts.lower, first);
      Add(parts.upper, first + std::uint32_t(parts.lower.items.size()));
    }
    return end;
  }

  void PlanPieces() {
    costs_.resize(plan_.size());
    threads_.For(std::int64_t(pieces_.size()), [&](std::int64_t i, int) {
      Piece& piece = pieces_[std::size_t(i)];
      const BvhRun& run = runs_[piece.node];
      piece.plan.reserve(run.items.size() / 2);
      costs_[piece.node] =
          PlanTree(splitter_, run, plan_[piece.node].first, piece.depth, &piece.plan);
    });
  }

  void CollapseUpper() {
    for (std::size_t i = plan_.size(); i-- > 0;) {
      BvhPlanNode& node = plan_[i];
      if (node.lower == 0) continue;  // PlanPieces has planned it
      const Collapse collapse = CollapseHalves(HalfArea(runs_[i].box), false,
                                               costs_[i + node.lower], costs_[i + node.upper]);
      SetCollapse(collapse, &node);
      costs_[i] = collapse.least;
    }
  }

  // Puts the root of each piece at its run's place in the plan and appends the rest of the piece.
  void AppendPieces() {
    std::vector<std::size_t> begins;
    std::size_t end = plan_.size();
    for (const Piece& piece : pieces_) {
      begins.push_back(end);
      end += piece.plan.size() - 1;
    }
    plan_.resize(end);
    threads_.For(std::int64_t(pieces_.size()), [&](std::int64_t i, int) {
      Piece& piece = pieces_[std::size_t(i)];
      const std::size_t begin = begins[std::size_t(i)];
      BvhPlanNode root = piece.plan[0];
      const auto moved = std::uint32_t(begin - 1 - piece.node);
      if (root.lower != 0) root.lower += moved, root.upper += moved;
      plan_[piece.node] = root;
      std::copy(piece.plan.begin() + 1, piece.plan.end(), plan_.begin() + std::ptrdiff_t(begin));
      piece.plan = {};
    });
  }

  Splitter splitter_;
  ThreadPool& threads_;
  std::vector<BvhPlanNode> plan_;
  std::vector<BvhRun> runs_;       // of the upper nodes and the pieces, indexed like the plan
  std::vector<ForestCost> costs_;  // indexed like the plan
  std::vector<Piece> pieces_;
};

}  // namespace

std::vector<BvhPlanNode> PlanBvh(const PrimitiveSet& primitives, std::uint32_t maxLeafTriangles,
                                 std::span<BvhItem> items, ThreadPool& threads, int sahDepth) {
  return Planner(Splitter(primitives, maxLeafTriangles, sahDepth), threads).Plan(items);
}

}  // namespace exphoton
