// SPDX-License-Identifier: BSD-2-Clause
// Searches in blocks of points under a tree of boxes: one implementation (nearest_search.inl),
// compiled for each width of vectors; the widest that the machine has is chosen when the program
// runs. All give the same answers, bit for bit, and the same as looking at every point would:
// neighbours are ordered by squared distance, ties by index.
#pragma once

#include <span>

#include "core/math/simd/real16.h"
#include "core/spatial/entry_grid.h"
#include "core/spatial/point_bvh.h"

namespace exphoton {

// Where the searches look. Blocks derive from PointBlock and follow one another.
struct PointTreeView {
  const PointBvh* tree = nullptr;
  const std::byte* blocks = nullptr;
  std::size_t blockBytes = sizeof(PointBlock);
  std::uint32_t count = 0;  // of points
  // Area round each run of kSpacingPoints points, by the squared radius, in which one point is to
  // be expected: only how long a search takes depends on it. May be null.
  const Real* spacing2 = nullptr;
  const EntryGrid* grid = nullptr;  // for the closest; may be null

  static constexpr std::uint32_t kSpacingPoints = 64;
};

struct NearestQuery {
  Point3 p;
  std::uint32_t k = 1;          // >= 1
  Real maxRadius2 = kInfinity;  // as far as this, inclusive; a distance whose square is infinite is
                                // never found
  // If set, a point at height h over the plane through p with normal n counts as if it were at
  // least h * steepness away.
  bool isFlattened = false;
  Real steepness = 0;
  bool isOneSided = false;  // with isFlattened: only points whose direction has dot(n, .) > 0
  Normal3 n;
};

// What a search found, by ascending index.
struct NearPoints {
  std::span<const Real> distance2;
  std::span<const std::uint32_t> index;
  std::size_t farthest = 0;  // its place in the two, the last of equals; 0 where nothing was found

  std::size_t size() const { return index.size(); }
};

// Room that a search for k needs.
class NearBuffer {
 public:
  static std::size_t SizeFor(std::size_t k) { return 4 * k + 5 * kBlockPoints; }
  std::span<Real> distance2;  // SizeFor(k) each
  std::span<std::uint32_t> index;
};

// One of the points that are disks: Reach2 below is the squared radius of each.
struct DiskBlock : PointBlock {
  Real reach2[kBlockPoints];
};

struct ClosestQuery {
  Point3 p;
  Normal3 n;  // unit
};

// For all queries of a search.
struct ClosestLimits {
  Real minCosine = 0;   // only points whose direction d has dot(n, d) > minCosine
  Real maxRadius2 = 0;  // none has a larger reach2
};

struct ClosestPoint {
  static constexpr std::uint32_t kNone = ~std::uint32_t(0);
  Real distance2 = kInfinity;
  std::uint32_t index = kNone;
};

struct NearestSearch {
  const char* name;
  // A block near p, for a view with points.
  std::uint32_t (*blockNear)(const PointTreeView&, const Point3& p);
  // The k nearest.
  NearPoints (*nearest)(const PointTreeView&, const NearestQuery&, const NearBuffer&);
  // For each query the nearest disk with an agreeing normal that reaches p. The view's blocks are
  // DiskBlocks. Many queries at once take less time each.
  void (*closest)(const PointTreeView&, const ClosestLimits&, std::span<const ClosestQuery>,
                  ClosestPoint* found);
};

extern const NearestSearch kPortableNearestSearch;
#if defined(EXPHOTON_WIDE_VECTORS)
extern const NearestSearch kAvx2NearestSearch;    // call only where the machine has AVX2
extern const NearestSearch kAvx512NearestSearch;  // and AVX-512 F
#endif

// Those that this machine can run, the fastest last.
std::span<const NearestSearch* const> AvailableNearestSearches();
const NearestSearch& FastestNearestSearch();

}  // namespace exphoton
