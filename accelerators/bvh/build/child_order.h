// SPDX-License-Identifier: BSD-2-Clause
// NearOrders and OrderByBlocking compute the orders in which rays visit the children of a node.
// Closest-hit rays visit them from front to back, by the signs of the ray's direction along the
// split axes. Shadow rays first visit the children that are most likely to block them per unit of
// work.
// Source: Fuetterling et al. 2017 (see bvh_layout.h); Nah and Manocha 2014, "SATO: surface area
// traversal order for shadow ray tracing".
#pragma once

#include <span>

#include "accelerators/bvh/bvh_layout.h"

namespace exphoton {

// NearOrders grows with each split of a node, which splits child `upper` off child `lower`.
class NearOrders {
 public:
  NearOrders();
  void Split(int lower, int upper, int axis);
  // Returns BvhNode::orders. Its last entry, the blocking order (OrderByBlocking), is still 0.
  std::array<BvhOrder, 5> Packed() const;

 private:
  std::array<std::array<std::uint8_t, kBvhWidth>, 4> orders_;
  int count_ = 1;
};

// Blocking describes a ray that enters a box, on average over all lines through the box.
struct Blocking {
  double chance = 0;  // probability that something in the box blocks the ray
  double work = 1;    // expected number of tests until the ray is known to be blocked or free
};

struct ChildBlocking {
  Blocking inside;
  double entered = 0;  // probability that a ray in the node enters this child
};

// Orders the children of a node and returns the Blocking of the node.
Blocking OrderByBlocking(std::span<const ChildBlocking> children, BvhOrder* order);

}  // namespace exphoton
