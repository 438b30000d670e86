// SPDX-License-Identifier: BSD-2-Clause
// These tests build the kd-tree of a large set in pieces by threads. The result must not depend on
// the number of threads, and it must give the hits of brute force.
#include <gtest/gtest.h>

#include <cstring>

#include "accelerators/kd/kd_build.h"
#include "core/scene/aggregate.h"
#include "tests/support/geometry_scenes.h"
#include "tests/support/test_plugin.h"

namespace exphoton {
namespace {

KdArrays Build(const PrimitiveSet& set, int maxDepth, int threads) {
  KdCosts costs;
  costs.intersect = 10, costs.traverse = 1, costs.emptyBonus = .2;
  costs.maxDepth = maxDepth;
  ThreadPool pool(threads);
  return BuildKdTree(set, costs, pool);
}

template <class Array>
bool HaveEqualBytes(const Array& a, const Array& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(a[0])) == 0;
}

TEST(KdBuild, GivesTheSameBytesWithAnyNumberOfThreads) {
  TestPlugins plugins;
  const auto set = CrowdOfTriangles(plugins);
  for (const int maxDepth : {0, 2, 27}) {  // one leaf; large cells that are not split; a tree
    const KdArrays expected = Build(*set, maxDepth, 1);
    EXPECT_GT(expected.nodes.size(), maxDepth > 2 ? 10000u : 0u);
    for (const int threads : {2, 5}) {
      const KdArrays found = Build(*set, maxDepth, threads);
      EXPECT_TRUE(HaveEqualBytes(expected.nodes, found.nodes)) << threads;
      EXPECT_TRUE(HaveEqualBytes(expected.blocks, found.blocks)) << threads;
      EXPECT_EQ(expected.entries, found.entries);
      EXPECT_EQ(expected.others, found.others);
      EXPECT_EQ(expected.bounds.min, found.bounds.min);
      EXPECT_EQ(expected.bounds.max, found.bounds.max);
    }
  }
}

TEST(KdBuild, OfManyPiecesAgreesWithBruteForce) {
  TestPlugins plugins;
  const auto set = CrowdOfTriangles(plugins);
  const auto one = plugins.MakeAccelerator(R"("kdtree")", *set);
  const auto two = plugins.MakeAccelerator(R"("kdtree")", *set, 2);
  EXPECT_EQ(one->MemoryBytes(), two->MemoryBytes());
  ExpectHitsOfBruteForce(*two, *set, plugins);
}

// Coincident triangles cannot be separated, so they form a leaf that is larger than a piece
// of the build.
TEST(KdBuild, PutsManyCoincidentTrianglesIntoOneLeaf) {
  const TriangleList triangles(20000, {Point3(0, 0, 0), Point3(1, 0, 0), Point3(0, 1, 0)});
  const auto set = TriangleSet(triangles);
  const KdArrays one = Build(*set, 20, 1), two = Build(*set, 20, 2);
  EXPECT_TRUE(HaveEqualBytes(one.nodes, two.nodes));
  EXPECT_TRUE(HaveEqualBytes(one.blocks, two.blocks));
  EXPECT_EQ(one.blocks.size(), 20000u / kBvhWidth);
}

TEST(KdBuild, OfNothingIsEmpty) {
  PrimitiveSet set;
  set.Finish();
  EXPECT_TRUE(Build(set, 10, 3).nodes.empty());
}

}  // namespace
}  // namespace exphoton
