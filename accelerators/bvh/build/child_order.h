// SPDX-License-Identifier: BSD-2-Clause
// The orders in which rays visit the children of a node: from near to far by the signs of their
// direction, as the splits say which side is which; and for rays that ask only whether anything is
// hit, what is most likely to block them for the least work first.
// Source: Fuetterling et al. 2017 (see bvh_layout.h); Nah and Manocha 2014, "SATO: surface area
// traversal order for shadow ray tracing".
#pragma once

#include <span>

#include "accelerators/bvh/bvh_layout.h"

namespace exphoton {

// Grows with the splits of a node: child `upper` has been split off child `lower`.
class NearOrders {
 public:
  NearOrders();
  void Split(int lower, int upper, int axis);
  // As BvhNode::orders; the blocking order is not filled in.
  std::array<BvhOrder, 5> Packed() const;

 private:
  std::array<std::array<std::uint8_t, kBvhWidth>, 4> orders_;
  int count_ = 1;
};

// What is known of a ray that enters a box, on average over all lines that meet it.
struct Blocking {
  double chance = 0;  // that something in the box blocks it
  double work = 1;    // tests until that is decided
};

struct ChildBlocking {
  Blocking inside;
  double entered = 0;  // chance that a ray that enters the node enters this child
};

// Orders the children of a node, whose Blocking it returns.
Blocking OrderByBlocking(std::span<const ChildBlocking> children, BvhOrder* order);

}  // namespace exphoton
