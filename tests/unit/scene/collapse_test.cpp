// SPDX-License-Identifier: BSD-2-Clause
// These tests compare the collapse of a binary tree into eight-wide nodes with every possible
// choice, on small random trees.
#include "accelerators/bvh/build/collapse.h"

#include <gtest/gtest.h>

#include <limits>
#include <vector>

#include "core/math/sampling/random.h"

namespace exphoton {
namespace {

struct TreeNode {
  double area = 1;
  std::size_t lower = 0, upper = 0;  // 0 for a leaf
  Collapse collapse;
};
using Tree = std::vector<TreeNode>;

// Splits random leaves until the tree has the given number of leaves. Areas are random and smaller
// at lower levels.
Tree RandomTree(std::size_t leaves, RandomStream* random) {
  Tree tree(1);
  for (std::size_t count = 1; count < leaves; ++count) {
    std::size_t split = 0;
    do split = std::min(std::size_t(random->Uniform() * Real(tree.size())), tree.size() - 1);
    while (tree[split].lower != 0);
    tree[split].lower = tree.size(), tree[split].upper = tree.size() + 1;
    for (int i = 0; i < 2; ++i)
      tree.push_back(
          {tree[split].area * double(Real(.2) + Real(.8) * random->Uniform()), 0, 0, {}});
  }
  for (std::size_t i = tree.size(); i-- > 0;) {
    TreeNode& node = tree[i];
    node.collapse = node.lower == 0
                        ? CollapseLeaf(node.area)
                        : CollapseHalves(node.area, false, tree[node.lower].collapse.least,
                                         tree[node.upper].collapse.least);
  }
  return tree;
}

// Returns the work below a node whose children are the nearest leaves and wide nodes. The work is
// infinite for more than eight children.
double WorkBelow(const Tree& tree, std::size_t node, const std::vector<bool>& isWide) {
  double work = 0;
  int children = 0;
  const auto descend = [&](const auto& self, std::size_t at) -> void {
    if (tree[at].lower == 0 || isWide[at]) {
      ++children;
      work += tree[at].area;
      if (tree[at].lower != 0) work += WorkBelow(tree, at, isWide);
    } else {
      self(self, tree[at].lower), self(self, tree[at].upper);
    }
  };
  descend(descend, tree[node].lower), descend(descend, tree[node].upper);
  return children > kBvhWidth ? std::numeric_limits<double>::infinity() : work;
}

double LeastWork(const Tree& tree) {
  std::vector<std::size_t> inner;
  for (std::size_t i = 1; i < tree.size(); ++i)
    if (tree[i].lower != 0) inner.push_back(i);
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t set = 0; set < std::size_t(1) << inner.size(); ++set) {
    std::vector<bool> isWide(tree.size());
    for (std::size_t i = 0; i < inner.size(); ++i) isWide[inner[i]] = set >> i & 1;
    least = std::min(least, tree[0].area + WorkBelow(tree, 0, isWide));
  }
  return least;
}

// Returns the work of the choice that the stored shares describe.
double WorkOfShares(const Tree& tree, std::size_t node) {
  double work = tree[node].area;
  int children = 0;
  const auto open = [&](const auto& self, std::size_t at, int most, int share) -> void {
    if (share == 0) {
      ++children;
      work += tree[at].collapse.isLeaf ? tree[at].area : WorkOfShares(tree, at);
      return;
    }
    const std::size_t lower = tree[at].lower, upper = tree[at].upper;
    self(self, lower, share, tree[lower].collapse.shares.Of(share));
    self(self, upper, most - share, tree[upper].collapse.shares.Of(most - share));
  };
  open(open, node, kBvhWidth, tree[node].collapse.shares.OfNode());
  EXPECT_LE(children, kBvhWidth);
  return work;
}

TEST(Collapse, TakesTheLeastWorkOfAllChoices) {
  RandomStream random(7);
  for (std::size_t leaves = 2; leaves <= 14; ++leaves) {
    for (int i = 0; i < 5; ++i) {
      const Tree tree = RandomTree(leaves, &random);
      const double least = LeastWork(tree);
      EXPECT_NEAR(tree[0].collapse.least[0], least, 1e-12 * least) << leaves << " leaves";
      EXPECT_NEAR(WorkOfShares(tree, 0), least, 1e-12 * least) << leaves << " leaves";
    }
  }
}

TEST(Collapse, MakesALeafOfHalvesThatSaveLess) {
  const ForestCost small = CollapseLeaf(.1).least, large = CollapseLeaf(.9).least;
  EXPECT_TRUE(CollapseHalves(1, true, large, large).isLeaf);
  EXPECT_FALSE(CollapseHalves(1, false, large, large).isLeaf);
  // Taken as one child, the node is a leaf. If there is room for two children, cheap
  // halves become two.
  const Collapse cheap = CollapseHalves(1, true, small, small);
  EXPECT_TRUE(cheap.isLeaf);
  EXPECT_EQ(cheap.shares.Of(2), 1);
  EXPECT_EQ(CollapseHalves(1, true, large, large).shares.Of(2), 0);
}

}  // namespace
}  // namespace exphoton
