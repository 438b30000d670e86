// SPDX-License-Identifier: BSD-2-Clause
// NearestSearch runs k-nearest-neighbour and closest-disk queries on blocks of points under a
// PointBvh. The implementation (nearest_search_simd.cpp) is compiled for several SIMD targets; the
// widest that the machine supports is chosen at run time. All targets give the same bits as a
// linear search over all points. Points are compared by squared distance. Of equally distant points
// the one with the lower index counts as nearer.
#pragma once

#include <span>

#include "core/spatial/point_tree.h"

namespace exphoton {

struct NearestQuery {
  Point3 p;
  std::uint32_t k = 1;          // >= 1
  Real maxRadius2 = kInfinity;  // inclusive; overflowed squared distances are never found
  // If set, the distance of a point is at least h * steepness, where h is its height over the plane
  // through p with normal n.
  bool isFlattened = false;
  Real steepness = 0;
  bool isOneSided = false;  // with isFlattened: only points with dot(n, direction) > 0
  Normal3 n;
};

// The result of a k-nearest-neighbour query. It is sorted by point index, not by distance.
struct NearPoints {
  std::span<const Real> distance2;
  std::span<const std::uint32_t> index;
  // Position in both arrays of the farthest point, the last of equals; 0 if empty.
  std::size_t farthest = 0;

  std::size_t size() const { return index.size(); }
};

// Buffer that a k-nearest-neighbour query needs.
class NearBuffer {
 public:
  static constexpr std::size_t SizeFor(std::size_t k) { return 4 * k + 5 * kBlockPoints; }
  std::span<Real> distance2;  // both have SizeFor(k) elements
  std::span<std::uint32_t> index;
};

struct ClosestQuery {
  Point3 p;
  Normal3 n;  // unit
};

// Limits that all queries of one call share.
struct ClosestLimits {
  Real minCosine = 0;   // only disks whose direction d has dot(n, d) > minCosine
  Real maxRadius2 = 0;  // upper bound of all radius2
};

struct ClosestPoint {
  static constexpr std::uint32_t kNone = ~std::uint32_t(0);
  Real distance2 = kInfinity;
  std::uint32_t index = kNone;
};

struct NearestSearch {
  const char* name;
  // Returns a block near p. The view must have points.
  std::uint32_t (*blockNear)(const PointTreeView&, const Point3& p);
  // Returns the k nearest points.
  NearPoints (*nearest)(const PointTreeView&, const NearestQuery&, const NearBuffer&);
  // Finds for each query the nearest disk that covers p and has an agreeing normal. The view's
  // blocks must be DiskBlocks. Batches of queries take less time per query.
  void (*closest)(const PointTreeView&, const ClosestLimits&, std::span<const ClosestQuery>,
                  ClosestPoint* found);
};

// Returns the searches that this machine can run, the fastest last.
std::span<const NearestSearch* const> AvailableNearestSearches();
const NearestSearch& FastestNearestSearch();

}  // namespace exphoton
