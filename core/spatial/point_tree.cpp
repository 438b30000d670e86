// SPDX-License-Identifier: BSD-2-Clause
// PointBvh: construction, from the blocks upwards.
#include "core/spatial/point_tree.h"

#include <algorithm>

namespace exphoton {

Bounds3 BoxNode::Bounds() const {
  Bounds3 bounds;
  for (std::uint32_t i = 0; i < kBoxChildren; ++i) {
    bounds.min = Min(bounds.min, {low[0][i], low[1][i], low[2][i]});
    bounds.max = Max(bounds.max, {high[0][i], high[1][i], high[2][i]});
  }
  return bounds;
}

void BoxNode::Set(std::uint32_t child, const Bounds3& bounds) {
  for (int axis = 0; axis < 3; ++axis) {
    low[axis][child] = bounds.min[axis];
    high[axis][child] = bounds.max[axis];
  }
}

PointBvh::PointBvh(const std::vector<Bounds3>& bounds) {
  // Adds a level over `count` boxes. The last node repeats the last box.
  const auto addLevel = [this](std::size_t count, const auto& boundsOf) {
    std::vector<BoxNode> nodes((count + kBoxChildren - 1) / kBoxChildren);
    for (std::size_t i = 0; i < nodes.size() * kBoxChildren; ++i)
      nodes[i / kBoxChildren].Set(i % kBoxChildren, boundsOf(std::min(i, count - 1)));
    levels_.push_back(std::move(nodes));
  };
  if (bounds.empty()) return;
  addLevel(bounds.size(), [&](std::size_t i) { return bounds[i]; });
  while (levels_.back().size() > 1)
    addLevel(levels_.back().size(), [&](std::size_t i) { return levels_.back()[i].Bounds(); });
}

std::size_t PointBvh::MemoryBytes() const {
  std::size_t bytes = 0;
  for (const auto& level : levels_) bytes += level.capacity() * sizeof(BoxNode);
  return bytes;
}

}  // namespace exphoton
