// SPDX-License-Identifier: BSD-2-Clause
// NearestCells: an index beside a PointKdTree that answers most questions for the nearest point at
// once, where points and questions lie on the same surfaces. Space close to the surfaces is cut
// into the cells of an octree; each lists the points nearest to its middle, and knows how far round
// the middle there is no other. What it cannot answer for certain is left to the tree, so answers
// are the same with and without it.
#pragma once

#include <array>
#include <cstdint>
#include <cstring>
#include <span>
#include <vector>

#include "core/base/parallel.h"
#include "core/spatial/point_kdtree.h"

namespace exphoton {

class NearestCells {
 public:
  static constexpr int kListed = 24;
  // Memory for each point, as measured in rooms; it depends on the surfaces.
  static constexpr std::size_t kTypicalBytesPerPoint = 90;

  struct Cell {
    std::uint32_t ids[kListed];  // in tree order, ascending
    Point3 middle;
    Real clear;  // every point nearer to the middle than this is listed

    // Whether a listed point at this squared distance from p is nearer than any that is not.
    bool Proves(Real distance2, const Point3& p) const {
      constexpr Real kSlack = Gamma(8);
      const Real guard = clear * (1 - kSlack) - Distance(p, middle) * (1 + kSlack);
      return guard > 0 && distance2 < Square(guard) * (1 - kSlack);
    }
  };

  NearestCells() = default;  // no cell
  // normals: of the surface at each point of the tree, in tree order, unit (either side). Points
  // are taken to have neighbours within the surface as far apart as their nearest ones.
  NearestCells(const PointKdTree& tree, std::span<const Normal3> normals, ThreadPool& threads);

  // The cell that p lies in; null where no surface is known to pass.
  const Cell* Around(const Point3& p) const;
  // Squared distances from p of what a cell lists.
  void Distances2(const Cell& cell, const Point3& p, Real (&distance2)[kListed]) const;
  // Ask for memory that Distances2 will read: the cell first, then what it lists.
  static void Prefetch(const Cell& cell) {
    __builtin_prefetch(&cell);
    __builtin_prefetch(&cell.middle);
  }
  void PrefetchListed(const Cell& cell) const {
    // Neighbours in tree order share lines of memory.
    for (int j = 0; j < kListed; j += 2) __builtin_prefetch(&places_[cell.ids[j]]);
  }
  std::size_t MemoryBytes() const;

 private:
  friend class NearestCellsBuilder;
  // A child: 0 none, the top bit set: a cell, otherwise a node.
  static constexpr std::uint32_t kIsCell = std::uint32_t(1) << 31;
  static constexpr int kTopLevels = 4, kMaxLevels = 14;
  using Node = std::array<std::uint32_t, 8>;

  Point3 origin_;
  Real scale_ = 0;                  // to cells of the finest level
  std::vector<std::uint32_t> top_;  // 2^kTopLevels cells an axis
  std::vector<Node> nodes_;         // [0] stands for none
  std::vector<Cell> cells_;
  // The points of the tree once more, x, y, z and 0 together: one read each.
  struct alignas(4 * sizeof(Real)) Place {
    Real coordinates[4];
  };
  std::vector<Place> places_;
};

// Four points at a time: their coordinates are read as rows and turned into columns.
inline void NearestCells::Distances2(const Cell& cell, const Point3& p,
                                     Real (&distance2)[kListed]) const {
  using Real4 = Real __attribute__((vector_size(4 * sizeof(Real))));
  const Real4 from{p.x, p.y, p.z, 0};
  const auto offset = [&](int j) {
    Real4 place;
    std::memcpy(&place, places_[cell.ids[j]].coordinates, sizeof place);
    return place - from;
  };
  for (int j = 0; j < kListed; j += 4) {
    const Real4 a = offset(j), b = offset(j + 1), c = offset(j + 2), d = offset(j + 3);
    const Real4 abLow = __builtin_shufflevector(a, b, 0, 4, 1, 5);  // xa xb ya yb
    const Real4 cdLow = __builtin_shufflevector(c, d, 0, 4, 1, 5);
    const Real4 abHigh = __builtin_shufflevector(a, b, 2, 6, 2, 6);  // za zb
    const Real4 cdHigh = __builtin_shufflevector(c, d, 2, 6, 2, 6);
    const Real4 x = __builtin_shufflevector(abLow, cdLow, 0, 1, 4, 5);
    const Real4 y = __builtin_shufflevector(abLow, cdLow, 2, 3, 6, 7);
    const Real4 z = __builtin_shufflevector(abHigh, cdHigh, 0, 1, 4, 5);
    const Real4 sum = x * x + y * y + z * z;
    std::memcpy(distance2 + j, &sum, sizeof sum);
  }
}

inline const NearestCells::Cell* NearestCells::Around(const Point3& p) const {
  constexpr Real kEnd = Real(1 << kMaxLevels);
  const Real x = (p.x - origin_.x) * scale_, y = (p.y - origin_.y) * scale_,
             z = (p.z - origin_.z) * scale_;
  // False for NaN too; and where there is no index, scale_ 0 leads to an empty top.
  if (!(x >= 0 && x < kEnd && y >= 0 && y < kEnd && z >= 0 && z < kEnd) || top_.empty())
    return nullptr;
  const auto ix = std::uint32_t(x), iy = std::uint32_t(y), iz = std::uint32_t(z);
  int shift = kMaxLevels - kTopLevels;
  std::uint32_t at = top_[((iz >> shift) << kTopLevels | iy >> shift) << kTopLevels | ix >> shift];
  while (at != 0 && !(at & kIsCell)) {
    --shift;
    at = nodes_[at][(iz >> shift & 1) << 2 | (iy >> shift & 1) << 1 | (ix >> shift & 1)];
  }
  return at == 0 ? nullptr : &cells_[at & ~kIsCell];
}

}  // namespace exphoton
