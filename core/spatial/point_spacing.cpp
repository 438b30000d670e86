// SPDX-License-Identifier: BSD-2-Clause
// Estimates the point density: bounding boxes give first guesses, and k-NN queries refine them.
#include "core/spatial/point_spacing.h"

#include <algorithm>

namespace exphoton {
namespace {

constexpr std::uint32_t kRunBlocks = PointTreeView::kSpacingPoints / kBlockPoints;
constexpr std::uint32_t kNeighbours = 32;
// Lower bound of spacing2, relative to the squared diagonal of all points. It keeps the first
// search radius above 0.
constexpr Real kLeast = Real(1) / Real(std::uint64_t(1) << 40);

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

std::vector<Real> MeasureSpacing2(PointTreeView view, ThreadPool& threads) {
  constexpr std::uint32_t kRun = PointTreeView::kSpacingPoints;
  const std::uint32_t runs = (view.count + kRun - 1) / kRun;
  std::vector<Real> guess2(runs), measured2(runs);
  if (runs == 0) return guess2;
  const Real least2 = LengthSquared(view.tree->Bounds().Diagonal()) * kLeast;
  for (std::uint32_t run = 0; run < runs; ++run)
    guess2[run] = std::max(LengthSquared(BoundsOfRun(view, run).Diagonal()) / kRun, least2);
  view.spacing2 = guess2.data();
  constexpr std::int64_t kChunk = 256;
  threads.For((runs + kChunk - 1) / kChunk, [&](std::int64_t chunk, int) {
    std::vector<Real> distance2(NearBuffer::SizeFor(kNeighbours));
    std::vector<std::uint32_t> index(distance2.size());
    NearestQuery query;
    query.k = kNeighbours;
    for (std::int64_t run = chunk * kChunk;
         run < std::min<std::int64_t>(runs, (chunk + 1) * kChunk); ++run) {
      const std::uint32_t middle = std::min(std::uint32_t(run) * kRun + kRun / 2, view.count - 1);
      query.p = reinterpret_cast<const PointBlock*>(
                    view.blocks + std::size_t(middle / kBlockPoints) * view.blockBytes)
                    ->Position(middle % kBlockPoints);
      const NearPoints near = FastestNearestSearch().nearest(view, query, {distance2, index});
      const Real farthest2 = near.size() == 0 ? 0 : near.distance2[near.farthest];
      measured2[run] = std::max(farthest2 / kNeighbours, least2);
    }
  });
  return measured2;
}

}  // namespace exphoton
