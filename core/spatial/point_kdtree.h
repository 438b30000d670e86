// SPDX-License-Identifier: BSD-2-Clause
// PointKdTree: nearest neighbours among points (photons), not geometry. A balanced tree whose shape
// follows from the number of points alone, so nodes hold only a split plane and lie in heap order;
// the points are stored in the order of the leaves, one coordinate after the other, so that a
// leaf's distances are computed several at a time. Bentley 1975; Friedman, Bentley and Finkel 1977
// (search with a shrinking bound).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/math/bounds.h"

namespace exphoton {

// A neighbour: `index` counts in tree order (PointKdTree::Order says where it came from).
struct NearPoint {
  Real distance2;
  std::uint32_t index;

  // Nearer first; ties by index, so that a result does not depend on how it was found.
  friend bool operator<(const NearPoint& a, const NearPoint& b) {
    return a.distance2 != b.distance2 ? a.distance2 < b.distance2 : a.index < b.index;
  }
};

class PointKdTree {
 public:
  static constexpr std::uint32_t kMaxLeafPoints = 16;
  static constexpr std::size_t kMaxPoints = std::size_t(1) << 31;

  PointKdTree() = default;  // no points: finds nothing
  // Points must be finite. Throws std::length_error above kMaxPoints.
  explicit PointKdTree(std::span<const Point3> points);

  std::size_t Size() const { return order_.size(); }
  // Order()[i] is the place in the constructor's span of the point at i in tree order.
  const std::vector<std::uint32_t>& Order() const { return order_; }
  Point3 Point(std::uint32_t index) const { return {x_[index], y_[index], z_[index]}; }
  const Bounds3& Bounds() const { return bounds_; }
  std::size_t MemoryBytes() const;

  // The tree's cells at a level, 0 to Levels(), are numbered from 0 to 2^level - 1: the one that p
  // is in, and a point in the middle of one's points.
  int Levels() const { return levels_; }
  std::uint32_t CellAt(const Point3& p, int level) const {
    std::uint32_t node = 0;
    for (int i = 0; i < level; ++i)
      node = 2 * node + 1 + std::uint32_t(!(p[int(nodes_[node].axis)] < nodes_[node].split));
    return node - ((std::uint32_t(1) << level) - 1);
  }
  std::uint32_t MiddleOf(std::uint32_t cell, int level) const {
    std::uint32_t begin = 0, end = std::uint32_t(order_.size());
    for (int i = level - 1; i >= 0; --i) {
      const std::uint32_t middle = begin + (end - begin) / 2;
      (cell >> i & 1 ? begin : end) = middle;
    }
    return begin + (end - begin) / 2;
  }

  // Points that lie together, at most kMaxLeafPoints: indices begin to begin + count. Their
  // coordinates may be read as if there were kMaxLeafPoints.
  struct Leaf {
    std::uint32_t begin, count;
    const Real *x, *y, *z;
  };
  // Calls visit(leaf, distance2) for every leaf that may hold points whose squared distance from p
  // is at most *radius2; distance2 has kMaxLeafPoints values. visit may lower *radius2.
  template <class VisitLeaf>
  void SearchLeaves(const Point3& p, Real* radius2, VisitLeaf&& visit) const;

  // Calls visit(index, distance2) for every point whose squared distance from p is at most
  // *radius2. visit may lower *radius2 as it finds what it wants; nothing beyond it is visited
  // afterwards.
  template <class Visit>
  void Search(const Point3& p, Real* radius2, Visit&& visit) const;

 private:
  struct Node {
    Real split;
    std::uint32_t axis;
  };

  void Build(std::span<const Point3> points, std::size_t node, std::uint32_t begin,
             std::uint32_t end);

  std::vector<Node> nodes_;      // node i has children 2i+1 and 2i+2; beyond the last level: leaves
  std::vector<Real> x_, y_, z_;  // kMaxLeafPoints longer than there are points
  std::vector<std::uint32_t> order_;
  Bounds3 bounds_;
  int levels_ = 0;  // of inner nodes
};

template <class Visit>
void PointKdTree::Search(const Point3& p, Real* radius2, Visit&& visit) const {
  SearchLeaves(p, radius2, [&](const Leaf& leaf, const Real* distance2) {
    for (std::uint32_t j = 0; j < leaf.count; ++j)
      if (distance2[j] <= *radius2) visit(leaf.begin + j, distance2[j]);
  });
}

template <class VisitLeaf>
void PointKdTree::SearchLeaves(const Point3& p, Real* radius2, VisitLeaf&& visit) const {
  // A subtree to be searched, with the offset of its region from p on each axis; the sum of their
  // squares is a lower bound of every distance in it (Arya and Mount 1993).
  struct Pending {
    std::uint32_t node, begin, end;
    int level;
    Vector3 offset;
    Real distance2;
  };
  // The bound is rounded too: a little less of it never hides a point.
  constexpr Real kSlack = 1 - Gamma(8);
  if (order_.empty() || !IsFinite(p)) return;
  Pending stack[32];  // at most one a level
  int depth = 0;
  Pending at{0, 0, std::uint32_t(order_.size()), 0, {}, 0};
  for (;;) {
    while (at.level < levels_) {
      const Node& node = nodes_[at.node];
      const std::uint32_t middle = at.begin + (at.end - at.begin) / 2;
      const int axis = int(node.axis);
      const Real delta = p[axis] - node.split;
      const Real far2 = (at.distance2 + (Square(delta) - Square(at.offset[axis]))) * kSlack;
      const bool isLeft = delta < 0;
      ++at.level;
      if (far2 <= *radius2) {
        Pending& far = stack[depth++];
        far = at;
        far.node = 2 * at.node + (isLeft ? 2 : 1);
        (isLeft ? far.begin : far.end) = middle;
        far.offset[axis] = delta;
        far.distance2 = far2;
      }
      at.node = 2 * at.node + (isLeft ? 1 : 2);
      (isLeft ? at.end : at.begin) = middle;
    }
    // A fixed number of lanes, some of them beyond the leaf: no branch until they are compared.
    Real distance2[kMaxLeafPoints];
    const Leaf leaf{at.begin, at.end - at.begin, &x_[at.begin], &y_[at.begin], &z_[at.begin]};
    for (std::uint32_t j = 0; j < kMaxLeafPoints; ++j) {
      const Real dx = leaf.x[j] - p.x, dy = leaf.y[j] - p.y, dz = leaf.z[j] - p.z;
      distance2[j] = dx * dx + dy * dy + dz * dz;
    }
    visit(leaf, distance2);
    do {
      if (depth == 0) return;
      at = stack[--depth];
    } while (!(at.distance2 <= *radius2));
  }
}

}  // namespace exphoton
