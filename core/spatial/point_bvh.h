// SPDX-License-Identifier: BSD-2-Clause
// PointBvh: bounding boxes over blocks of points, sixteen to a node, level upon level. Its shape
// follows from the number of blocks alone: child i of node n is node 16 n + i of the level below,
// and at the lowest level block 16 n + i. The searches (nearest_search.h) walk it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/base/parallel.h"
#include "core/math/bounds.h"
#include "core/spatial/point_block.h"

namespace exphoton {

inline constexpr std::uint32_t kBoxChildren = 16;

// The bounds of sixteen children. Where there are fewer, the last one is repeated (PointBlock).
struct alignas(64) BoxNode {
  Real low[3][kBoxChildren], high[3][kBoxChildren];

  Bounds3 Bounds() const;  // of all children
  void Set(std::uint32_t child, const Bounds3& bounds);
};

class PointBvh {
 public:
  static constexpr int kMaxLevels = 8;
  static constexpr std::size_t kMaxPoints = std::size_t(1) << 31;

  PointBvh() = default;  // of no points
  // bounds[i]: of block i.
  explicit PointBvh(const std::vector<Bounds3>& bounds);

  int Levels() const { return int(levels_.size()); }
  const BoxNode* Level(int level) const { return levels_[level].data(); }  // 0: above the blocks
  Bounds3 Bounds() const { return levels_.empty() ? Bounds3() : levels_.back().front().Bounds(); }
  std::size_t MemoryBytes() const;

 private:
  std::vector<std::vector<BoxNode>> levels_;
};

}  // namespace exphoton
