// SPDX-License-Identifier: BSD-2-Clause
// EntryGrid: chooses the cell size and asks the BVH for the block near each cell's centre.
#include "core/spatial/entry_grid.h"

#include <cmath>

#include "core/spatial/nearest/nearest_search.h"

namespace exphoton {

EntryGrid::EntryGrid(const PointTreeView& view, std::size_t cells, ThreadPool& threads) {
  if (view.count == 0) return;
  const Bounds3 bounds = view.tree->Bounds();
  const Vector3 size = bounds.Diagonal();
  const Real longest = MaxComponent(size);
  origin_ = bounds.min;
  // Finds the largest number of cells along the longest side for which the total is at most
  // `cells`.
  const auto countsFor = [&](std::uint32_t along) {
    std::size_t total = 1;
    for (int axis = 0; axis < 3; ++axis) {
      counts_[axis] = 1 + std::uint32_t(size[axis] / longest * Real(along));
      total *= counts_[axis];
    }
    return total;
  };
  std::uint32_t along = 0;
  const bool isExtended = longest > 0 && std::isfinite(longest) && std::isfinite(1 / longest);
  for (std::uint32_t step = std::uint32_t(1) << 12; isExtended && step > 0; step /= 2)
    if (countsFor(along + step) <= cells) along += step;
  if (along == 0) {
    counts_[0] = counts_[1] = counts_[2] = 1;
  } else {
    countsFor(along);
    scale_ = Real(along) / longest;
  }
  blocks_.resize(std::size_t(counts_[0]) * counts_[1] * counts_[2]);
  threads.For(std::int64_t(counts_[2]) * counts_[1], [&](std::int64_t row, int) {
    for (std::uint32_t x = 0; x < counts_[0]; ++x) {
      Point3 middle = origin_;
      if (scale_ > 0)
        middle += Vector3(Real(x) + Real(.5), Real(row % counts_[1]) + Real(.5),
                          Real(row / counts_[1]) + Real(.5)) *
                  (1 / scale_);
      blocks_[std::size_t(row) * counts_[0] + x] = FastestNearestSearch().blockNear(view, middle);
    }
  });
}

}  // namespace exphoton
