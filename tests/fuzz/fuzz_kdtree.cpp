// SPDX-License-Identifier: BSD-2-Clause
// The point kd-tree finds what brute force finds, for any finite points.
#include <algorithm>
#include <vector>

#include "core/spatial/nearest_set.h"
#include "core/spatial/point_kdtree.h"
#include "tests/fuzz/input.h"

using namespace exphoton;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  fuzz::Input input(data, size);
  const int k = 1 + input.Byte() % 64;
  const Point3 query = input.AnyPoint();
  // Farther apart than this, squared distances are infinite for every search.
  const auto isNear = [](const Point3& p) {
    return std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}) < Real(1e18);
  };
  std::vector<Point3> points;
  while (!input.IsEmpty() && points.size() < 2000) {
    const Point3 p = input.AnyPoint();
    if (IsFinite(p) && isNear(p)) points.push_back(p);
  }
  const PointKdTree tree(points);
  std::vector<NearPoint> all, found(NearestSet<KeepAll>::BufferSize(k));
  NearestSet nearest(std::span<NearPoint>(found), k, KeepAll());
  Real radius2 = kInfinity;
  tree.SearchLeaves(query, &radius2, [&](const PointKdTree::Leaf& leaf, const Real* distance2) {
    nearest.OfferLeaf(leaf, distance2, &radius2);
  });
  const auto seen = nearest.Finish();
  if (!IsFinite(query)) {
    fuzz::Require(seen.empty(), "nothing is near a query that is no point");
    return 0;
  }
  if (!isNear(query)) return 0;
  for (std::uint32_t i = 0; i < tree.Size(); ++i)
    all.push_back({DistanceSquared(tree.Point(i), query), i});
  std::sort(all.begin(), all.end());
  std::vector<Real> sorted;
  for (const NearPoint& each : seen) sorted.push_back(each.distance2);
  std::sort(sorted.begin(), sorted.end());
  fuzz::Require(sorted.size() == std::min(all.size(), std::size_t(k)), "as many as there are");
  for (std::size_t i = 0; i < sorted.size(); ++i)
    fuzz::Require(sorted[i] == all[i].distance2, "the nearest");
  return 0;
}
