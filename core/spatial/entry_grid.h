// SPDX-License-Identifier: BSD-2-Clause
// EntryGrid: space cut into cubes, for each of which a block of points near its middle is known:
// where a search for the closest point begins. Only how long a search takes depends on it.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "core/base/parallel.h"
#include "core/math/bounds.h"

namespace exphoton {

struct PointTreeView;

class EntryGrid {
 public:
  EntryGrid() = default;  // without cells
  // At most about `cells` cells over the points of the view, and at least one where there is one.
  EntryGrid(const PointTreeView& view, std::size_t cells, ThreadPool& threads);

  // Places outside of the grid count as its rim. p must be finite.
  std::uint32_t BlockNear(const Point3& p) const {
    const auto along = [this](Real offset, std::uint32_t count) {
      const Real at = std::min(std::max(offset * scale_, Real(0)), Real(count - 1));
      return std::uint32_t(at);
    };
    const std::uint32_t x = along(p.x - origin_.x, counts_[0]),
                        y = along(p.y - origin_.y, counts_[1]),
                        z = along(p.z - origin_.z, counts_[2]);
    return blocks_[(std::size_t(z) * counts_[1] + y) * counts_[0] + x];
  }
  std::size_t MemoryBytes() const { return blocks_.capacity() * sizeof(std::uint32_t); }

 private:
  Point3 origin_;
  Real scale_ = 0;  // cells for each unit of length
  std::uint32_t counts_[3] = {0, 0, 0};
  std::vector<std::uint32_t> blocks_;
};

}  // namespace exphoton
