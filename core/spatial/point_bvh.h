// SPDX-License-Identifier: BSD-2-Clause
// PointBvh is an implicit 16-wide hierarchy of bounding boxes over blocks of points. Child i of
// node n is node 16 n + i of the level below, or block 16 n + i at the lowest level. It needs no
// pointers, because its shape depends only on the number of blocks. The searches in
// nearest_search.h traverse it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/base/parallel.h"
#include "core/math/bounds.h"
#include "core/spatial/point_block.h"

namespace exphoton {

inline constexpr std::uint32_t kBoxChildren = 16;

// The bounds of sixteen children. A node with fewer children repeats the bounds of the last child,
// as PointBlock repeats its last point.
struct alignas(64) BoxNode {
  Real low[3][kBoxChildren], high[3][kBoxChildren];

  Bounds3 Bounds() const;  // of all children
  void Set(std::uint32_t child, const Bounds3& bounds);
};

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

}  // namespace exphoton
