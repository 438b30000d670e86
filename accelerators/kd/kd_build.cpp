// SPDX-License-Identifier: BSD-2-Clause
// Top-down construction, one cell after the other, below before above, so that a child below its
// plane follows its parent in memory.
#include "accelerators/kd/kd_build.h"

#include <utility>

#include "accelerators/kd/clip_triangle.h"
#include "accelerators/kd/kd_split.h"
#include "core/base/error.h"

namespace exphoton {
namespace {

// Larger by at least the margin on every side, and by one step of Real where that is more.
Bounds3 Grown(const Bounds3& bounds, Real margin) {
  Bounds3 grown = bounds;
  for (int axis = 0; axis < 3; ++axis) {
    grown.min[axis] = NextDown(bounds.min[axis] - margin);
    grown.max[axis] = NextUp(bounds.max[axis] + margin);
  }
  return grown;
}

Bounds3 Intersection(const Bounds3& a, const Bounds3& b) {
  Bounds3 both;
  both.min = Max(a.min, b.min), both.max = Min(a.max, b.max);
  return both;
}

Real MarginOf(const Bounds3& bounds) { return kKdMargin * MaxComponent(bounds.Diagonal()); }

// Entries of all leaves together, for the primitives that lie in many cells: a soup of large
// triangles would fill any memory otherwise.
constexpr double kEntriesPerItem = 12, kFreeEntries = 1000;

class Builder {
 public:
  Builder(const PrimitiveSet& primitives, const KdCosts& costs)
      : primitives_(primitives), costs_(costs) {}

  KdArrays Build() && {
    std::vector<KdItem> items;
    items.reserve(primitives_.Count());
    for (std::uint32_t id = 0; id < primitives_.Count(); ++id) {
      const Bounds3 bounds = primitives_.Bounds(id);
      if (bounds.IsEmpty()) continue;  // an instance of nothing
      items.push_back({id, Grown(bounds, MarginOf(bounds))});
      arrays_.bounds.Extend(items.back().bounds);
    }
    if (!items.empty()) {
      const double budget = kEntriesPerItem * double(items.size()) + kFreeEntries;
      Cell(std::move(items), arrays_.bounds, {costs_.maxDepth, 0, budget});
    }
    arrays_.nodes.shrink_to_fit();
    arrays_.blocks.shrink_to_fit();
    arrays_.entries.shrink_to_fit();
    return std::move(arrays_);
  }

 private:
  // What keeps the tree finite.
  struct Limits {
    int depth;       // levels left
    int badSplits;   // above this cell, that did not pay by themselves
    double entries;  // this cell's share of all entries that leaves may have together
  };

  void Cell(std::vector<KdItem> items, const Bounds3& cell, Limits limits) {
    if (items.size() <= costs_.maxPrimitives || limits.depth <= 0) return Leaf(items);
    const KdSplit split = FindKdSplit(items, cell, costs_);
    const double leafCost = costs_.intersect * KdBlocks(items.size());
    if (split.axis < 0) return Leaf(items);
    if (split.cost >= leafCost) {
      // Worse at first may be better later, but only in small cells and within reason.
      if (++limits.badSplits > 2 || items.size() > 32 || split.cost > 1.5 * leafCost)
        return Leaf(items);
    }
    const Real position = Real(split.position);
    Bounds3 low = cell, high = cell;
    low.max[split.axis] = position;
    high.min[split.axis] = position;
    std::vector<KdItem> below, above;
    for (const KdItem& item : items) {
      const bool isBelow = IsBelow(item, split.axis, position);
      const bool isAbove = IsAbove(item, split.axis, position);
      if (isBelow && isAbove) {
        AddClipped(item, low, &below);
        AddClipped(item, high, &above);
      } else {
        (isBelow ? below : above).push_back(item);
      }
    }
    const double together = double(below.size() + above.size());
    if (together > limits.entries) return Leaf(items);
    if (below.size() == items.size() && above.size() == items.size()) return Leaf(items);
    items = {};
    const auto share = [&](std::size_t count) -> Limits {
      return {limits.depth - 1, limits.badSplits, limits.entries * double(count) / together};
    };
    const Limits belowLimits = share(below.size()), aboveLimits = share(above.size());
    const std::uint32_t index = NewNode();
    Cell(std::move(below), low, belowLimits);
    const std::uint32_t aboveIndex = std::uint32_t(arrays_.nodes.size());
    Cell(std::move(above), high, aboveLimits);
    KdNode& node = arrays_.nodes[index];
    node.split = split.position;
    node.bits = aboveIndex << 2 | std::uint32_t(split.axis);
  }

  // The item as it is within a smaller cell; dropped where only its bounds reach into it.
  void AddClipped(const KdItem& item, const Bounds3& cell, std::vector<KdItem>* items) const {
    Bounds3 bounds = Intersection(item.bounds, cell);
    if (item.id < primitives_.TriangleCount()) {
      const auto vertices = primitives_.TriangleVertices(item.id);
      const Real margin = MarginOf(primitives_.Bounds(item.id));
      const Bounds3 clipped = ClipTriangle(vertices, Grown(cell, margin));
      if (clipped.IsEmpty()) return;
      bounds = Intersection(bounds, Grown(clipped, margin));
      if (bounds.IsEmpty()) return;
    }
    items->push_back({item.id, bounds});
  }

  std::uint32_t NewNode() {
    if (arrays_.nodes.size() >= (std::size_t(1) << 30))
      throw Error(ExitStatus::Resource, "the kd-tree has more than 2^30 nodes");
    arrays_.nodes.push_back({});
    return std::uint32_t(arrays_.nodes.size() - 1);
  }

  void Leaf(const std::vector<KdItem>& items) {
    const std::uint32_t index = NewNode();
    std::vector<std::uint32_t> triangles, others;
    for (const KdItem& item : items)
      (item.id < primitives_.TriangleCount() ? triangles : others).push_back(item.id);
    const std::size_t first = arrays_.blocks.size();
    for (std::size_t i = 0; i < triangles.size(); i += kBvhWidth) {
      const std::size_t count = std::min(triangles.size() - i, std::size_t(kBvhWidth));
      arrays_.blocks.push_back(MakeBlock(primitives_, std::span(triangles).subspan(i, count)));
    }
    const std::size_t blocks = arrays_.blocks.size() - first;
    if (blocks >= (std::size_t(1) << 29) || arrays_.blocks.size() >= (std::size_t(1) << 32))
      throw Error(ExitStatus::Resource, "the kd-tree has more than 2^32 blocks of triangles");
    arrays_.nodes[index] =
        KdNode::Leaf(std::uint32_t(first), std::uint32_t(blocks), !others.empty());
    if (others.empty()) return;
    if (arrays_.entries.size() + others.size() >= (std::size_t(1) << 32) - 1)
      throw Error(ExitStatus::Resource, "the kd-tree has more than 2^32 entries");
    arrays_.others[index] = std::uint32_t(arrays_.entries.size());
    arrays_.entries.push_back(std::uint32_t(others.size()));
    arrays_.entries.insert(arrays_.entries.end(), others.begin(), others.end());
  }

  const PrimitiveSet& primitives_;
  const KdCosts costs_;
  KdArrays arrays_;
};

}  // namespace

KdArrays BuildKdTree(const PrimitiveSet& primitives, const KdCosts& costs) {
  return Builder(primitives, costs).Build();
}

}  // namespace exphoton
