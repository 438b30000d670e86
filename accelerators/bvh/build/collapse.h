// SPDX-License-Identifier: BSD-2-Clause
// Which nodes of a binary tree become nodes of eight, so that the work expected of a ray is least:
// by dynamic programming from the leaves up.
// Source: Ylitie, Karras and Laine 2017, "Efficient incoherent ray traversal on GPUs through
// compressed wide BVHs", section 3.1; the costs are those of MacDonald and Booth 1990.
#pragma once

#include <array>
#include <cstdint>

#include "accelerators/bvh/bvh_layout.h"

namespace exphoton {

// least[k - 1]: the expected work (half areas times visits) of all below a node of the binary tree,
// that node included, if it stands for at most k children of a node of eight.
using ForestCost = std::array<double, kBvhWidth>;

// Of the children that a node of the binary tree stands for, how many its lower half has. Four
// bits for each number of children.
class ForestShares {
 public:
  // Where it becomes a node of eight itself. 0: it cannot, for it has no halves.
  int OfNode() const { return int(bits_ & 15); }
  // Where it stands for at most `children`, 1 to 8. 0: it is a single child.
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
  bool isLeaf = false;  // where it is a single child; of others there is a node of eight
};

// Of a leaf of the binary tree.
Collapse CollapseLeaf(double halfArea);
// Of a node with two halves, which may be a leaf all the same.
Collapse CollapseHalves(double halfArea, bool canBeLeaf, const ForestCost& lower,
                        const ForestCost& upper);

}  // namespace exphoton
