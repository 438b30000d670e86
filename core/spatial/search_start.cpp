// SPDX-License-Identifier: BSD-2-Clause
// The constructor of EntryGrid chooses the cell size and asks the BVH for the block near each
// cell's centre. MeasureSpacing2 guesses the spacing from bounding boxes and refines it by k-NN
// queries.
#include "core/spatial/search_start.h"

#include <cmath>

#include "core/spatial/nearest_search.h"

namespace exphoton {
namespace {

// A run is a sequence of kSpacingPoints points that share one value of spacing2. spacing2 is the
// squared distance to the k-th neighbour divided by k. On a surface this hardly depends on k.
constexpr std::uint32_t kRunBlocks = PointTreeView::kSpacingPoints / kBlockPoints;
// Lower bound of spacing2, relative to the squared diagonal of all points. It keeps the first
// search radius above 0.
constexpr Real kMinRelativeSpacing2 = Real(1) / Real(std::uint64_t(1) << 40);

Bounds3 BoundsOfRun(const PointTreeView& view, std::uint32_t run) {
  const BoxNode& node = view.tree->Level(0)[run * kRunBlocks / kBoxChildren];
  Bounds3 bounds;
  for (std::uint32_t i = 0; i < kRunBlocks; ++i) {
    const std::uint32_t child = (run * kRunBlocks + i) % kBoxChildren;
    for (int axis = 0; axis < 3; ++axis) {
      bounds.min[axis] = std::min(bounds.min[axis], node.low[axis][child]);
      bounds.max[axis] = std::max(bounds.max[axis], node.high[axis][child]);
    }
  }
  return bounds;
}

}  // namespace

EntryGrid::EntryGrid(const PointTreeView& view, std::size_t cells, ThreadPool& threads) {
  if (view.count == 0) return;
  const Bounds3 bounds = view.tree->Bounds();
  const Vector3 size = bounds.Diagonal();
  const Real longest = MaxComponent(size);
  origin_ = bounds.min;
  // Sets counts_ for this number of cells along the longest side, and returns their total.
  const auto countsFor = [&](std::uint32_t along) {
    std::size_t total = 1;
    for (int axis = 0; axis < 3; ++axis) {
      counts_[axis] = 1 + std::uint32_t(size[axis] / longest * Real(along));
      total *= counts_[axis];
    }
    return total;
  };
  // The largest number along the longest side for which the total is at most `cells`.
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
      Point3 center = origin_;
      if (scale_ > 0)
        center += Vector3(Real(x) + Real(.5), Real(row % counts_[1]) + Real(.5),
                          Real(row / counts_[1]) + Real(.5)) *
                  (1 / scale_);
      blocks_[std::size_t(row) * counts_[0] + x] = FastestNearestSearch().blockNear(view, center);
    }
  });
}

std::vector<Real> MeasureSpacing2(PointTreeView view, ThreadPool& threads) {
  constexpr std::uint32_t kRun = PointTreeView::kSpacingPoints;
  const std::uint32_t runs = (view.count + kRun - 1) / kRun;
  std::vector<Real> guess2(runs), measured2(runs);
  if (runs == 0) return guess2;
  const Real least2 = LengthSquared(view.tree->Bounds().Diagonal()) * kMinRelativeSpacing2;
  for (std::uint32_t run = 0; run < runs; ++run)
    guess2[run] = std::max(LengthSquared(BoundsOfRun(view, run).Diagonal()) / kRun, least2);
  view.spacing2 = guess2.data();
  constexpr std::int64_t kChunk = 256;
  threads.For((runs + kChunk - 1) / kChunk, [&](std::int64_t chunk, int) {
    std::vector<Real> distance2(NearBuffer::SizeFor(kSpacingNeighbours));
    std::vector<std::uint32_t> index(distance2.size());
    NearestQuery query;
    query.k = kSpacingNeighbours;
    for (std::int64_t run = chunk * kChunk;
         run < std::min<std::int64_t>(runs, (chunk + 1) * kChunk); ++run) {
      const std::uint32_t point = std::min(std::uint32_t(run) * kRun + kRun / 2, view.count - 1);
      query.p = reinterpret_cast<const PointBlock*>(
                    view.blocks + std::size_t(point / kBlockPoints) * view.blockBytes)
                    ->Position(point % kBlockPoints);
      const NearPoints near = FastestNearestSearch().nearest(view, query, {distance2, index});
      const Real farthest2 = near.size() == 0 ? 0 : near.distance2[near.farthest];
      measured2[run] = std::max(farthest2 / kSpacingNeighbours, least2);
    }
  });
  return measured2;
}

}  // namespace exphoton
