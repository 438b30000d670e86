// SPDX-License-Identifier: BSD-2-Clause
// Builder splits cells from the root downwards. It sorts the ends of the primitives' bounds along
// each axis and splits a cell at the end with the lowest expected cost. It does not clip primitives
// to cells.
#include "accelerators/kd/kd_build.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "core/base/error.h"

namespace exphoton {
namespace {

// In a cell with more primitives, the bounds of about this number of them represent all.
constexpr std::size_t kSample = 64;

// The number of references to primitives in all leaves together is limited to
// kEntriesPerItem * primitives + kFreeEntries. Without this limit, a soup of large triangles, each
// in many cells, could fill any memory.
constexpr double kEntriesPerItem = 12, kFreeEntries = 1000;

using Ids = std::vector<std::uint32_t>;

struct Cell {
  Bounds3 bounds;
  int depth;       // levels left
  int badSplits;   // splits above this cell that cost more than a leaf
  double entries;  // references that all leaves below this cell may have together
};

struct Split {
  int axis = -1;  // -1: there is no plane inside the cell
  float position = 0;
  double cost = 0;  // expected cost of a ray that enters the cell
};

// Returns the number of block tests in a leaf: leaves test eight triangles at a time.
double Blocks(std::size_t count) { return double((count + kBvhWidth - 1) / kBvhWidth); }

class Builder {
 public:
  Builder(const PrimitiveSet& primitives, const KdSettings& settings)
      : primitives_(primitives), settings_(settings) {}

  KdArrays Build() && {
    Ids items;
    bounds_.reserve(primitives_.Count());
    for (std::uint32_t id = 0; id < primitives_.Count(); ++id) {
      bounds_.push_back(primitives_.Bounds(id));
      if (bounds_[id].IsEmpty()) continue;  // an empty instance
      bounds_[id] = PaddedBounds(bounds_[id]);
      arrays_.bounds.Extend(bounds_[id]);
      items.push_back(id);
    }
    if (items.empty()) return {};
    const double entries = kEntriesPerItem * double(items.size()) + kFreeEntries;
    AddCell(std::move(items), {arrays_.bounds, settings_.maxDepth, 0, entries});
    MakeBlocks();
    return std::move(arrays_);
  }

 private:
  // Appends the nodes of a cell and of everything below it in depth-first order.
  void AddCell(Ids items, Cell cell) {
    if (items.size() <= std::size_t(settings_.maxPrimitives) || cell.depth == 0)
      return AddLeaf(items);
    const Split split = CheapestSplit(items, cell.bounds, (items.size() + kSample - 1) / kSample);
    if (!IsWorthwhile(split, items.size(), &cell.badSplits)) return AddLeaf(items);
    const Real position = Real(split.position);
    Ids below, above;
    for (const std::uint32_t id : items) {
      if (bounds_[id].min[split.axis] < position) below.push_back(id);
      if (bounds_[id].max[split.axis] > position) above.push_back(id);
    }
    const double sum = double(below.size() + above.size());
    if (sum > cell.entries || sum == 2 * double(items.size())) return AddLeaf(items);
    Cell cellBelow = cell, cellAbove = cell;
    cellBelow.bounds.max[split.axis] = cellAbove.bounds.min[split.axis] = position;
    cellBelow.depth = cellAbove.depth = cell.depth - 1;
    cellBelow.entries *= double(below.size()) / sum;
    cellAbove.entries *= double(above.size()) / sum;
    items = {};
    const std::size_t node = arrays_.nodes.size();
    arrays_.nodes.emplace_back();
    AddCell(std::move(below), cellBelow);
    arrays_.nodes[node] =
        KdNode::Inner(split.axis, split.position, std::uint32_t(arrays_.nodes.size()));
    AddCell(std::move(above), cellAbove);
  }

  // Counts a split that costs more than a leaf. Such a split may still pay off further down. It is
  // made only in small cells, if at most 1.5 times as expensive, and twice on a path from the root.
  bool IsWorthwhile(const Split& split, std::size_t items, int* badSplits) const {
    if (split.axis < 0) return false;
    const double leafCost = settings_.intersectCost * Blocks(items);
    if (split.cost < leafCost) return true;
    return ++*badSplits <= 2 && items <= 32 && split.cost <= 1.5 * leafCost;
  }

  // Looks at one of `step` primitives. Looks at all if no split among those pays off.
  Split CheapestSplit(std::span<const std::uint32_t> items, const Bounds3& cell, std::size_t step) {
    Split best;
    for (int axis = 0; axis < 3; ++axis) {
      begins_.clear(), ends_.clear();
      for (std::size_t i = 0; i < items.size(); i += step) {
        begins_.push_back(bounds_[items[i]].min[axis]);
        ends_.push_back(bounds_[items[i]].max[axis]);
      }
      std::sort(begins_.begin(), begins_.end());
      std::sort(ends_.begin(), ends_.end());
      TryPlanes(cell, axis, double(items.size()) / double(begins_.size()), &best);
    }
    const bool isGood =
        best.axis >= 0 && best.cost < settings_.intersectCost * Blocks(items.size());
    return isGood || step == 1 ? best : CheapestSplit(items, cell, 1);
  }

  // Sweeps a plane over the sorted ends of bounds along one axis. Each of them represents `weight`
  // primitives. By the surface area heuristic, a ray that enters the cell enters a part with the
  // ratio of the surface areas as its probability.
  void TryPlanes(const Bounds3& cell, int axis, double weight, Split* best) const {
    const auto length = [&](int i) { return double(cell.max[i % 3]) - double(cell.min[i % 3]); };
    const double end = length(axis + 1) * length(axis + 2);  // half the area of both ends
    const double perLength = length(axis + 1) + length(axis + 2);
    const double area = end + perLength * length(axis);
    if (!(area > 0 && area < double(kInfinity))) return;
    const std::size_t count = begins_.size();
    std::size_t begun = 0, ended = 0;  // before the plane; up to and including the plane
    while (ended < count) {
      const bool isBegin = begun < count && begins_[begun] < ends_[ended];
      const Real plane = isBegin ? begins_[begun] : ends_[ended];
      while (ended < count && ends_[ended] == plane) ++ended;
      const float position = float(plane);
      if (Real(position) > cell.min[axis] && Real(position) < cell.max[axis]) {
        const auto below = std::size_t(double(begun) * weight);
        const auto above = std::size_t(double(count - ended) * weight);
        const double toBelow = (end + perLength * (double(plane) - double(cell.min[axis]))) / area;
        const double toAbove = (end + perLength * (double(cell.max[axis]) - double(plane))) / area;
        const double bonus = below == 0 || above == 0 ? 1 - double(settings_.emptyBonus) : 1;
        const double cost =
            settings_.traversalCost +
            settings_.intersectCost * bonus * (toBelow * Blocks(below) + toAbove * Blocks(above));
        if (best->axis < 0 || cost < best->cost) *best = {axis, position, cost};
      }
      while (begun < count && begins_[begun] == plane) ++begun;
    }
  }

  void AddLeaf(std::span<const std::uint32_t> items) {
    const std::size_t first = triangles_.size() / kBvhWidth, list = arrays_.lists.size();
    Ids others;
    for (const std::uint32_t id : items)
      (id < primitives_.TriangleCount() ? triangles_ : others).push_back(id);
    while (triangles_.size() % kBvhWidth != 0) triangles_.push_back(kNoId);
    const std::size_t blocks = triangles_.size() / kBvhWidth - first;
    if (!others.empty()) {
      arrays_.lists.insert(arrays_.lists.end(),
                           {std::uint32_t(first), std::uint32_t(others.size())});
      arrays_.lists.insert(arrays_.lists.end(), others.begin(), others.end());
    }
    constexpr std::size_t kMaxIndex = std::size_t(1) << 29;  // numbers fit into the bits of nodes
    if (arrays_.nodes.size() >= 2 * kMaxIndex || blocks >= kMaxIndex ||
        first + blocks >= 8 * kMaxIndex || arrays_.lists.size() >= 8 * kMaxIndex)
      throw Error(ExitStatus::Resource, "the kd-tree is too large for its node format");
    arrays_.nodes.push_back(KdNode::Leaf(std::uint32_t(others.empty() ? first : list),
                                         std::uint32_t(blocks), !others.empty()));
  }

  void MakeBlocks() {
    arrays_.blocks.reserve(triangles_.size() / kBvhWidth);
    for (std::size_t i = 0; i < triangles_.size(); i += kBvhWidth) {
      const auto ids = std::span(triangles_).subspan(i, kBvhWidth);
      const auto count = std::find(ids.begin(), ids.end(), kNoId) - ids.begin();
      arrays_.blocks.push_back(MakeBlock(primitives_, ids.first(std::size_t(count))));
    }
  }

  const PrimitiveSet& primitives_;
  const KdSettings& settings_;
  std::vector<Bounds3> bounds_;      // of each primitive, with margins
  std::vector<Real> begins_, ends_;  // sorted; reused by every cell
  Ids triangles_;                    // of all leaves, kBvhWidth per block, padded with kNoId
  KdArrays arrays_;
};

}  // namespace

KdArrays BuildKdTree(const PrimitiveSet& primitives, const KdSettings& settings) {
  return Builder(primitives, settings).Build();
}

}  // namespace exphoton
