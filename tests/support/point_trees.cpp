// SPDX-License-Identifier: BSD-2-Clause
#include "tests/support/point_trees.h"

#include <algorithm>

namespace exphoton {

TestPointTree::TestPointTree(const std::vector<TestDisk>& disks, int threads) {
  ThreadPool pool(threads);
  BlockStore<TestDiskBlock> store;
  store.Append(disks);
  tree_ = PointTree<TestDiskBlock>(std::move(store), pool);
  spacing2_ = MeasureSpacing2(tree_.View(), pool);
  grid_ = EntryGrid(tree_.View(), 2 * tree_.Size(), pool);
}

TestPointTree::TestPointTree(const std::vector<Point3>& points, int threads)
    : TestPointTree(
          [&] {
            std::vector<TestDisk> disks;
            for (const Point3& p : points) disks.push_back({p});
            return disks;
          }(),
          threads) {}

PointTreeView TestPointTree::View() const {
  PointTreeView view = tree_.View();
  view.spacing2 = spacing2_.data();
  view.grid = &grid_;
  return view;
}

std::vector<TestPointTree::Near> TestPointTree::Nearest(const NearestSearch& search,
                                                        const NearestQuery& query) const {
  std::vector<Real> distance2(NearBuffer::SizeFor(query.k));
  std::vector<std::uint32_t> index(distance2.size());
  const NearPoints found = search.nearest(View(), query, {distance2, index});
  std::vector<Near> near;
  for (std::size_t i = 0; i < found.size(); ++i)
    near.push_back({found.distance2[i], found.index[i]});
  std::sort(near.begin(), near.end());
  return near;
}

std::vector<TestPointTree::Near> TestPointTree::NearestByBruteForce(
    const NearestQuery& query) const {
  std::vector<Near> near;
  for (std::uint32_t i = 0; i < tree_.Size() && IsFinite(query.p); ++i) {
    Real distance2 = DistanceSquared(tree_.Position(i), query.p);
    if (query.isFlattened) {
      const Real height = Dot(tree_.Position(i) - query.p, query.n);
      distance2 = std::max(distance2, Square(height * query.steepness));
      if (query.isOneSided && !(Dot(tree_.Direction(i), query.n) > 0)) continue;
    }
    if (distance2 <= query.maxRadius2 && distance2 < kInfinity) near.push_back({distance2, i});
  }
  std::sort(near.begin(), near.end());
  near.resize(std::min<std::size_t>(query.k, near.size()));
  return near;
}

ClosestPoint TestPointTree::ClosestByBruteForce(const ClosestQuery& query,
                                                const ClosestLimits& limits) const {
  ClosestPoint best;
  for (std::uint32_t i = 0; i < tree_.Size() && IsFinite(query.p); ++i) {
    const Real distance2 = DistanceSquared(tree_.Position(i), query.p);
    const auto& block = tree_.BlockOf(i);
    if (!(distance2 <= limits.maxRadius2 && distance2 < best.distance2)) continue;
    if (!(distance2 <= block.radius2[tree_.Lane(i)])) continue;
    if (Dot(tree_.Direction(i), query.n) > limits.minCosine) best = {distance2, i};
  }
  return best;
}

}  // namespace exphoton
