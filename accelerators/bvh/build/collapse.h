// SPDX-License-Identifier: BSD-2-Clause
// CollapseLeaf and CollapseHalves choose which nodes of a binary BVH become nodes or leaves of the
// 8-wide BVH. Dynamic programming from the leaves up minimises the expected work of a ray. Source:
// Ylitie, Karras and Laine 2017, "Efficient incoherent ray traversal on GPUs through compressed
// wide BVHs", section 3.1; the costs are those of MacDonald and Booth 1990.
#pragma once

#include <array>
#include <cstdint>

#include "accelerators/bvh/bvh_layout.h"

namespace exphoton {

// A subtree of the binary BVH can occupy up to 8 child slots of one 8-wide node: it then becomes a
// forest of up to 8 subtrees. Element k - 1 is its least cost if it may use k slots. The cost is
// the sum of half area times visit cost over the nodes and leaves made from it.
using ForestCost = std::array<double, kBvhWidth>;

// If a subtree may use k slots, ForestShares stores how many of them go to its lower half. The
// upper half may use the others. Each k takes four bits.
class ForestShares {
 public:
  // Returns how many of the 8 slots go to the lower half if this node itself becomes an 8-wide
  // node. 0: the node is a leaf of the binary BVH.
  int OfNode() const { return int(bits_ & 15); }
  // Returns how many slots go to the lower half if the subtree may use `children` slots, 1 to 8. 0:
  // the subtree uses one slot only.
  int Of(int children) const { return children > 1 ? At(children) : 0; }

  void SetOfNode(int share) { bits_ |= std::uint32_t(share); }
  void Set(int children, int share) { bits_ |= std::uint32_t(share) << (4 * (children - 1)); }

 private:
  int At(int children) const { return int(bits_ >> (4 * (children - 1)) & 15); }

  std::uint32_t bits_ = 0;
};

struct Collapse {
  ForestCost least;
  ForestShares shares;
  bool isLeaf = false;  // a single child is a leaf; otherwise it is an 8-wide node
};

// Returns the Collapse of a leaf of the binary tree.
Collapse CollapseLeaf(double halfArea);
// Returns the Collapse of a node with two halves. If canBeLeaf, the node may also become a leaf.
Collapse CollapseHalves(double halfArea, bool canBeLeaf, const ForestCost& lower,
                        const ForestCost& upper);

}  // namespace exphoton
