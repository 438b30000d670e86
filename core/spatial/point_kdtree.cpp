// SPDX-License-Identifier: BSD-2-Clause
// PointKdTree: building by medians along the longest side.
#include "core/spatial/point_kdtree.h"

#include <algorithm>
#include <numeric>
#include <stdexcept>

namespace exphoton {

PointKdTree::PointKdTree(std::span<const Point3> points) {
  if (points.size() > kMaxPoints) throw std::length_error("too many points for one kd-tree");
  if (points.empty()) return;
  order_.resize(points.size());
  std::iota(order_.begin(), order_.end(), 0u);
  for (std::size_t largest = points.size(); largest > kMaxLeafPoints; ++levels_)
    largest = (largest + 1) / 2;
  nodes_.resize((std::size_t(1) << levels_) - 1);
  Build(points, 0, 0, std::uint32_t(points.size()));
  for (auto* coordinates : {&x_, &y_, &z_}) coordinates->resize(points.size() + kMaxLeafPoints);
  for (std::size_t i = 0; i < order_.size(); ++i) {
    const Point3& p = points[order_[i]];
    x_[i] = p.x;
    y_[i] = p.y;
    z_[i] = p.z;
    bounds_.Extend(p);
  }
}

void PointKdTree::Build(std::span<const Point3> points, std::size_t node, std::uint32_t begin,
                        std::uint32_t end) {
  if (node >= nodes_.size()) return;
  Bounds3 bounds;
  for (std::uint32_t i = begin; i < end; ++i) bounds.Extend(points[order_[i]]);
  const int axis = MaxDimension(bounds.Diagonal());
  const std::uint32_t middle = begin + (end - begin) / 2;
  std::nth_element(order_.begin() + begin, order_.begin() + middle, order_.begin() + end,
                   [&](std::uint32_t a, std::uint32_t b) {
                     const Real pa = points[a][axis], pb = points[b][axis];
                     return pa != pb ? pa < pb : a < b;
                   });
  nodes_[node] = {points[order_[middle]][axis], std::uint32_t(axis)};
  Build(points, 2 * node + 1, begin, middle);
  Build(points, 2 * node + 2, middle, end);
}

std::size_t PointKdTree::MemoryBytes() const {
  return nodes_.capacity() * sizeof(Node) + 3 * x_.capacity() * sizeof(Real) +
         order_.capacity() * sizeof(std::uint32_t);
}

}  // namespace exphoton
