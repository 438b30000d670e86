// SPDX-License-Identifier: BSD-2-Clause
// TestPointTree is a point tree for tests of searches, with brute-force searches for comparison.
#pragma once

#include <vector>

#include "core/spatial/nearest_search.h"
#include "core/spatial/search_start.h"

namespace exphoton {

struct TestDisk {
  Point3 p;
  std::uint32_t direction = EncodeOctahedral({0, 0, 1});
  Real radius2 = kInfinity;
};
struct TestDiskBlock : DiskBlock {
  using Record = TestDisk;
  void Set(std::uint32_t lane, const TestDisk& disk) {
    PointBlock::Set(lane, {disk.p, disk.direction});
    radius2[lane] = disk.radius2;
  }
};

class TestPointTree {
 public:
  explicit TestPointTree(const std::vector<TestDisk>& disks, int threads = 1);
  explicit TestPointTree(const std::vector<Point3>& points, int threads = 1);

  const PointTree<TestDiskBlock>& Tree() const { return tree_; }
  PointTreeView View() const;

  struct Near {
    Real distance2;
    std::uint32_t index;
    friend auto operator<=>(const Near&, const Near&) = default;
  };
  // Returns the nearest point first.
  std::vector<Near> Nearest(const NearestSearch& search, const NearestQuery& query) const;
  std::vector<Near> NearestByBruteForce(const NearestQuery& query) const;
  ClosestPoint ClosestByBruteForce(const ClosestQuery& query, const ClosestLimits& limits) const;

 private:
  PointTree<TestDiskBlock> tree_;
  std::vector<Real> spacing2_;
  EntryGrid grid_;
};

}  // namespace exphoton
