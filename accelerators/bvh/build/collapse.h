// SPDX-License-Identifier: BSD-2-Clause
// CollapseLeaf and CollapseHalves choose which nodes of a binary tree become 8-wide nodes. Dynamic
// programming from the leaves up minimises the expected work of a ray.
// Source: Ylitie, Karras and Laine 2017, "Efficient incoherent ray traversal on GPUs through
// compressed wide BVHs", section 3.1; the costs are those of MacDonald and Booth 1990.
#pragma once

#include <array>
#include <cstdint>

#include "accelerators/bvh/bvh_layout.h"

namespace exphoton {

// least[k - 1] is the least expected work (half areas times visits) in a subtree of the binary
// tree, if the subtree is represented by at most k children of an 8-wide node.
using ForestCost = std::array<double, kBvhWidth>;

// A subtree of the binary tree may be represented by k children of an 8-wide node. ForestShares
// stores how many of them belong to the lower half, in four bits for each k.
class ForestShares {
 public:
  // Returns the share of an 8-wide node made from this node itself. 0: impossible, as it has no
  // halves.
  int OfNode() const { return int(bits_ & 15); }
  // Returns the share if the subtree gets at most `children` children, 1 to 8. 0: it is a single
  // child.
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
