// SPDX-License-Identifier: BSD-2-Clause
#include "accelerators/kd/kd_cell.h"

#include "accelerators/kd/clip_triangle.h"

namespace exphoton {
namespace {

// Pads the bounds on every side by at least the margin and at least one floating-point step.
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

// Adds the item with its bounds clipped to a smaller cell. A triangle is dropped if only its
// bounds, but no part of it, reach into the cell.
void AddClipped(const PrimitiveSet& primitives, const KdItem& item, const Bounds3& cell,
                std::vector<KdItem>* items) {
  Bounds3 bounds = Intersection(item.bounds, cell);
  if (item.id < primitives.TriangleCount()) {
    const auto vertices = primitives.TriangleVertices(item.id);
    const Real margin = MarginOf(primitives.Bounds(item.id));
    const Bounds3 clipped = ClipTriangle(vertices, Grown(cell, margin));
    if (clipped.IsEmpty()) return;
    bounds = Intersection(bounds, Grown(clipped, margin));
    if (bounds.IsEmpty()) return;
  }
  items->push_back({item.id, bounds});
}

}  // namespace

bool KdCell::Accepts(const KdSplit& split, std::size_t items, const KdCosts& costs) {
  if (split.axis < 0) return false;
  const double leafCost = costs.intersect * KdBlocks(items);
  if (split.cost < leafCost) return true;
  // A split that costs more than a leaf may still pay off further down. It is accepted only in
  // small cells, at most 1.5 times as expensive, and twice on any path from the root.
  return ++limits.badSplits <= 2 && items <= 32 && split.cost <= 1.5 * leafCost;
}

KdCut::KdCut(const KdCell& cell, const KdSplit& split)
    : axis(split.axis), position(Real(split.position)), below(cell), above(cell) {
  below.bounds.max[axis] = position;
  above.bounds.min[axis] = position;
}

bool KdCut::Share(std::size_t items, std::size_t itemsBelow, std::size_t itemsAbove) {
  const double together = double(itemsBelow + itemsAbove);
  if (together > below.limits.entries || !(together > 0)) return false;
  if (itemsBelow == items && itemsAbove == items) return false;
  --below.limits.depth, --above.limits.depth;
  below.limits.entries = below.limits.entries * double(itemsBelow) / together;
  above.limits.entries = above.limits.entries * double(itemsAbove) / together;
  return true;
}

Bounds3 KdItemBounds(const Bounds3& bounds) { return Grown(bounds, MarginOf(bounds)); }

void PartKdItems(const PrimitiveSet& primitives, std::span<const KdItem> items, const KdCut& cut,
                 std::vector<KdItem>* below, std::vector<KdItem>* above) {
  std::size_t countBelow = 0, countAbove = 0;  // upper bounds
  for (const KdItem& item : items) {
    countBelow += IsBelow(item, cut.axis, cut.position);
    countAbove += IsAbove(item, cut.axis, cut.position);
  }
  below->reserve(countBelow);
  above->reserve(countAbove);
  for (const KdItem& item : items) {
    const bool isBelow = IsBelow(item, cut.axis, cut.position);
    const bool isAbove = IsAbove(item, cut.axis, cut.position);
    if (isBelow && isAbove) {
      AddClipped(primitives, item, cut.below.bounds, below);
      AddClipped(primitives, item, cut.above.bounds, above);
    } else {
      (isBelow ? below : above)->push_back(item);
    }
  }
}

}  // namespace exphoton
