// SPDX-License-Identifier: BSD-2-Clause
// The recurrence for the least cost of a subtree: either it becomes a single node or leaf, or its
// slots are divided between its halves in the best way.
#include "accelerators/bvh/build/collapse.h"

#include <limits>

namespace exphoton {
namespace {

// Visits of a node and of a leaf take about the same time. Doubling one of the two costs changes
// hardly any tree.
constexpr double kNodeVisit = 1, kLeafVisit = 1;

}  // namespace

Collapse CollapseLeaf(double halfArea) {
  Collapse leaf;
  leaf.least.fill(kLeafVisit * halfArea);
  leaf.isLeaf = true;
  return leaf;
}

Collapse CollapseHalves(double halfArea, bool canBeLeaf, const ForestCost& lower,
                        const ForestCost& upper) {
  Collapse best;
  // Element k - 1: the least cost if the halves share k slots.
  ForestCost opened;
  std::array<int, kBvhWidth> shares{};
  opened.fill(std::numeric_limits<double>::infinity());
  for (int k = 2; k <= kBvhWidth; ++k) {
    for (int share = 1; share < k; ++share) {
      const double cost = lower[share - 1] + upper[k - share - 1];
      if (cost < opened[k - 1]) opened[k - 1] = cost, shares[k - 1] = share;
    }
  }
  const double asNode = opened[kBvhWidth - 1] + kNodeVisit * halfArea;
  best.isLeaf = canBeLeaf && kLeafVisit * halfArea <= asNode;
  const double single = best.isLeaf ? kLeafVisit * halfArea : asNode;
  best.shares.SetOfNode(shares[kBvhWidth - 1]);
  best.least[0] = single;
  for (int k = 2; k <= kBvhWidth; ++k) {
    const bool isOpened = opened[k - 1] <= single;
    best.least[k - 1] = isOpened ? opened[k - 1] : single;
    if (isOpened) best.shares.Set(k, shares[k - 1]);
  }
  return best;
}

}  // namespace exphoton
