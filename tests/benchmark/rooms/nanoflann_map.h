// SPDX-License-Identifier: BSD-2-Clause
// NanoflannMap searches with nanoflann (1.4.3) as the photon maps do, with the same conditions
// inside the search. It is the opponent of core/spatial.
#pragma once

#include <nanoflann.hpp>

#include <algorithm>
#include <limits>
#include <span>
#include <vector>

#include "core/math/vec.h"

namespace exphoton {

class NanoflannMap {
 public:
  explicit NanoflannMap(std::vector<Point3> points)
      : cloud_{std::move(points)}, tree_(3, cloud_, nanoflann::KDTreeSingleIndexAdaptorParams(10)) {
    tree_.buildIndex();  // leaves of ten: nanoflann's default
  }

  const Point3& At(std::uint32_t index) const { return cloud_.points[index]; }

  struct Near {
    float distance2;
    std::uint32_t index;
    friend bool operator<(const Near& a, const Near& b) { return a.distance2 < b.distance2; }
  };

  // Returns the k nearest points within the radius, the farthest first. measure(index, distance2)
  // may increase a distance; infinity excludes a point.
  template <class Measure>
  std::span<const Near> Nearest(const Point3& p, std::size_t k, float radius2, Near* buffer,
                                Measure&& measure) const {
    Heap<Measure> heap{buffer, k, 0, std::nextafter(radius2, 3e38f), measure};
    const float query[3] = {float(p.x), float(p.y), float(p.z)};
    tree_.findNeighbors(heap, query, nanoflann::SearchParams());
    return {buffer, heap.count};
  }

 private:
  // Heap is the result set for nanoflann. For many neighbours it is faster than nanoflann's sorted
  // list.
  template <class Measure>
  struct Heap {
    Near* near;
    std::size_t k, count;
    float limit;
    Measure& measure;

    bool addPoint(float distance2, std::uint32_t index) {
      distance2 = measure(index, distance2);
      if (!(distance2 < limit)) return true;
      if (count == k) std::pop_heap(near, near + count--);
      near[count++] = {distance2, index};
      std::push_heap(near, near + count);
      if (count == k) limit = near[0].distance2;
      return true;
    }
    float worstDist() const { return limit; }
    bool full() const { return count == k; }
    std::size_t size() const { return count; }
  };

  struct Cloud {
    std::vector<Point3> points;
    std::size_t kdtree_get_point_count() const { return points.size(); }
    float kdtree_get_pt(std::size_t i, std::size_t axis) const { return points[i][int(axis)]; }
    template <class Box>
    bool kdtree_get_bbox(Box&) const {
      return false;
    }
  };

  Cloud cloud_;
  nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<float, Cloud, float>, Cloud, 3,
                                      std::uint32_t>
      tree_;
};

}  // namespace exphoton
