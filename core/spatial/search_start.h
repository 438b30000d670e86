// SPDX-License-Identifier: BSD-2-Clause
// EntryGrid and MeasureSpacing2 choose how searches begin: the block to scan first, and the
// first radius to try. They affect the time of a search only, never its result. But density
// estimates use the spacing as well, so pictures depend on MeasureSpacing2.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "core/spatial/point_tree.h"

namespace exphoton {

// EntryGrid divides space into cubic cells and stores for each a block of points near its centre. A
// closest-disk search (ClosestDisks in nearest_search.h: the nearest point whose own disk covers
// the query) scans that block first, to start with a small radius.
class EntryGrid {
 public:
  EntryGrid() = default;  // no cells
  // Makes at most `cells` cells over the points of the view, but at least one if there are points.
  EntryGrid(const PointTreeView& view, std::size_t cells, ThreadPool& threads);

  // Positions outside the grid are clamped to its border cells. p must be finite, and the grid must
  // have cells.
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
  Real scale_ = 0;  // cells per unit of length
  std::uint32_t counts_[3] = {0, 0, 0};
  std::vector<std::uint32_t> blocks_;
};

// MeasureSpacing2 estimates the local point density, from which k-NN queries choose their first
// radius. It returns for each run of PointTreeView::kSpacingPoints points the squared radius round
// the run's middle point that is expected to contain one point. The spacing2 of the view is
// ignored.
std::vector<Real> MeasureSpacing2(PointTreeView view, ThreadPool& threads);
// It looks at this number of points around the middle one. Fewer points show no spacing.
constexpr std::uint32_t kSpacingNeighbours = 32;

}  // namespace exphoton
