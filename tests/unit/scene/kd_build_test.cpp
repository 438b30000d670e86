// SPDX-License-Identifier: BSD-2-Clause
// These tests build the kd-tree of large and of awkward sets. The tree must not depend on the
// number of threads, it must stay within its limits, and it must give the hits of brute force.
#include "accelerators/kd/kd_build.h"

#include <gtest/gtest.h>

#include <cstring>

#include "core/scene/aggregate.h"
#include "tests/support/geometry_scenes.h"
#include "tests/support/test_plugin.h"

namespace exphoton {
namespace {

KdArrays Build(const PrimitiveSet& set, int maxDepth) {
  KdSettings settings;
  settings.intersectCost = 10, settings.traversalCost = 1;
  settings.maxDepth = maxDepth;
  return BuildKdTree(set, settings);
}

// Returns the number of nodes on the longest path from a node to a leaf.
int DepthOf(const KdArrays& tree, std::size_t node) {
  const KdNode& at = tree.nodes[node];
  if (at.IsLeaf()) return 1;
  return 1 + std::max(DepthOf(tree, node + 1), DepthOf(tree, at.Above()));
}

// Returns the number of references to triangles, shapes and instances in all leaves.
std::size_t ReferencesOf(const KdArrays& tree) {
  std::size_t references = 0;
  for (const BvhBlock& block : tree.blocks)
    for (const std::uint32_t id : block.ids) references += id != kNoId;
  for (const KdNode& node : tree.nodes)
    if (node.IsLeaf() && node.HasOthers()) references += tree.lists[node.first + 1];
  return references;
}

TEST(KdBuild, GivesTheSameBytesEveryTime) {
  TestPlugins plugins;
  const auto set = CrowdOfTriangles(plugins);
  const KdArrays one = Build(*set, 27), two = Build(*set, 27);
  EXPECT_GT(one.nodes.size(), 5000u);
  ASSERT_EQ(one.nodes.size(), two.nodes.size());
  ASSERT_EQ(one.blocks.size(), two.blocks.size());
  EXPECT_EQ(0, std::memcmp(one.nodes.data(), two.nodes.data(), one.nodes.size() * sizeof(KdNode)));
  EXPECT_EQ(
      0, std::memcmp(one.blocks.data(), two.blocks.data(), one.blocks.size() * sizeof(BvhBlock)));
  EXPECT_EQ(one.lists, two.lists);
}

TEST(KdBuild, OfACrowdAgreesWithBruteForce) {
  TestPlugins plugins;
  const auto set = CrowdOfTriangles(plugins);
  const auto one = plugins.MakeAccelerator(R"("kdtree")", *set);
  const auto two = plugins.MakeAccelerator(R"("kdtree")", *set, 2);
  EXPECT_EQ(one->MemoryBytes(), two->MemoryBytes());
  ExpectHitsOfBruteForce(*one, *set, plugins);
  ExpectHitsOfBruteForce(*two, *set, plugins);
}

TEST(KdBuild, SplitsNoDeeperThanItsLimit) {
  TestPlugins plugins;
  const auto set = CrowdOfTriangles(plugins);
  EXPECT_EQ(Build(*set, 0).nodes.size(), 1u);
  EXPECT_EQ(DepthOf(Build(*set, 5), 0), 1 + 5);
  EXPECT_GT(DepthOf(Build(*set, 27), 0), 12);
}

// Every plane that separates a few of these triangles cuts all the others.
TEST(KdBuild, OfLargeCrossingTrianglesLimitsItsReferences) {
  RandomStream random(3);
  TriangleList triangles;
  for (int i = 0; i < 20000; ++i) {
    const Point3 p = Point3() + RandomVector(random) * Real(.4);
    triangles.push_back({p + Vector3(-1, -1, -1), p + Vector3(1, 1, -1), p + Vector3(0, -1, 1)});
  }
  const auto set = TriangleSet(triangles);
  KdSettings settings;
  settings.intersectCost = 1000, settings.traversalCost = 0, settings.maxDepth = kKdMaxDepth;
  const KdArrays tree = BuildKdTree(*set, settings);
  EXPECT_GT(tree.nodes.size(), 100u);
  EXPECT_LE(ReferencesOf(tree), 12u * 20000 + 1000);
}

// Coincident triangles cannot be separated.
TEST(KdBuild, PutsManyCoincidentTrianglesIntoOneLeaf) {
  const TriangleList triangles(20000, {Point3(0, 0, 0), Point3(1, 0, 0), Point3(0, 1, 0)});
  const KdArrays tree = Build(*TriangleSet(triangles), 20);
  EXPECT_EQ(tree.blocks.size(), 20000u / kBvhWidth);
  EXPECT_EQ(ReferencesOf(tree), 20000u);
}

// Returns the number of blocks in the largest leaf.
std::uint32_t LargestLeaf(const KdArrays& tree) {
  std::uint32_t largest = 0;
  for (const KdNode& node : tree.nodes)
    if (node.IsLeaf()) largest = std::max(largest, node.Blocks());
  return largest;
}

// Returns triangles of about the given size in a cube of size 2.
TriangleList SmallTriangles(int count, Real size, RandomStream& random) {
  TriangleList triangles;
  for (int i = 0; i < count; ++i) {
    const Point3 p = Point3() + RandomVector(random);
    const Vector3 u = RandomVector(random) * size;
    triangles.push_back({p, p + u, p + RandomVector(random) * size});
  }
  return triangles;
}

// In a large cell only some of the bounds are sorted. The one far triangle may not be among them.
TEST(KdBuild, SeparatesACrowdFromATriangleFarAway) {
  RandomStream random(4);
  TriangleList triangles = SmallTriangles(5000, Real(.02), random);
  triangles.insert(triangles.begin() + 777,
                   {Point3(1e6, 0, 0), Point3(Real(1e6) + 1, 0, 0), Point3(1e6, 1, 0)});
  const auto set = TriangleSet(triangles);
  EXPECT_LE(LargestLeaf(Build(*set, 27)), 5u);
}

// Every hundredth triangle is the same and contains all others in its bounds. If only these are
// sorted, no plane is inside the cell.
TEST(KdBuild, SplitsACrowdWithRepeatedTriangles) {
  RandomStream random(8);
  TriangleList triangles = SmallTriangles(6400, Real(.02), random);
  for (std::size_t i = 0; i < triangles.size(); i += 100)
    triangles[i] = {Point3(-2, -2, -2), Point3(2, -2, 2), Point3(-2, 2, 2)};
  EXPECT_LE(LargestLeaf(Build(*TriangleSet(triangles), 27)), 20u);
}

// The bounds of the largest triangle overflow with their margin.
TEST(KdBuild, SplitsACrowdWithinBoundsThatOverflow) {
  RandomStream random(6);
  TriangleList triangles = SmallTriangles(500, Real(.1), random);
  const Real far = std::numeric_limits<Real>::max() / 2;
  triangles.push_back({Point3(-far, 2, -far), Point3(far, 2, -far), Point3(0, 2, far)});
  const KdArrays tree = Build(*TriangleSet(triangles), 60);
  EXPECT_LT(MaxComponent(Abs(tree.bounds.max - Point3())), kInfinity);
  EXPECT_LE(LargestLeaf(tree), 12u);
}

TEST(KdBuild, OfNothingIsEmpty) {
  PrimitiveSet set;
  set.Finish();
  EXPECT_TRUE(Build(set, 10).nodes.empty());
}

}  // namespace
}  // namespace exphoton
