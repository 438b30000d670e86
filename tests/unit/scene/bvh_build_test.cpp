// SPDX-License-Identifier: BSD-2-Clause
// These tests build the BVH of a large set in pieces by threads. The result must not depend on the
// number of threads, and it must give the hits of brute force.
#include <gtest/gtest.h>

#include <cstring>

#include "accelerators/bvh/build/bvh_build.h"
#include "accelerators/bvh/build/bvh_plan.h"
#include "core/scene/aggregate.h"
#include "tests/support/geometry_scenes.h"
#include "tests/support/test_plugin.h"

namespace exphoton {
namespace {

TEST(BvhBuild, GivesTheSameBytesWithAnyNumberOfThreads) {
  TestPlugins plugins;
  const auto set = CrowdOfTriangles(plugins);
  ThreadPool one(1), three(3);
  const BvhArrays expected = BuildBvh(*set, 8, one), found = BuildBvh(*set, 8, three);
  ASSERT_EQ(expected.lines.size(), found.lines.size());
  EXPECT_EQ(0, std::memcmp(expected.lines.data(), found.lines.data(),
                           expected.lines.size() * sizeof(BvhLine)));
  EXPECT_EQ(expected.others, found.others);
  EXPECT_EQ(expected.depth, found.depth);
}

TEST(BvhBuild, OfManyPiecesAgreesWithBruteForce) {
  TestPlugins plugins;
  const auto set = CrowdOfTriangles(plugins);
  ExpectHitsOfBruteForce(*plugins.MakeAccelerator(R"("bvh")", *set, 2), *set, plugins);
}

// Shapes that are no triangles are in a list of their own.
TEST(BvhBuild, CountsTheBytesOfLinesAndOfTheListOfShapes) {
  TestPlugins plugins;
  PrimitiveSet set;
  for (int i = 0; i < 3; ++i)
    set.AddShape(std::move(std::get<std::unique_ptr<Shape>>(
                     plugins.MakeShape("\"sphere\"", Transform::Translate({Real(3 * i), 0, 0})))),
                 {});
  set.Finish();
  ThreadPool threads(1);
  const BvhArrays arrays = BuildBvh(set, 8, threads);
  ASSERT_FALSE(arrays.others.empty());
  EXPECT_EQ(plugins.MakeAccelerator(R"("bvh")", set)->MemoryBytes(),
            arrays.lines.size() * sizeof(BvhLine) + arrays.others.size() * 4);
}

// Returns the depth of the binary tree. The eight-wide nodes are made from some of its nodes.
int DepthOf(std::span<const BvhPlanNode> plan, std::size_t node) {
  const BvhPlanNode& at = plan[node];
  if (at.lower == 0) return 0;
  return 1 + std::max(DepthOf(plan, node + at.lower), DepthOf(plan, node + at.upper));
}

// Each triangle is three quarters as large as the one before, about the same corner. SAH splits
// repeatedly separate only a few of the largest triangles.
TEST(BvhBuild, HalvesRunsBelowADepth) {
  TriangleList triangles;
  Real size = Real(1e36);
  for (int i = 0; i < 500; ++i, size *= Real(.75))
    triangles.push_back({Point3(size, 0, size), Point3(0, size, size), Point3(size, size, 0)});
  const auto set = TriangleSet(triangles);
  std::vector<BvhItem> items;
  for (std::uint32_t id = 0; id < set->Count(); ++id) items.emplace_back(set->Bounds(id), id);
  ThreadPool threads(1);
  EXPECT_GT(DepthOf(PlanBvh(*set, 1, items, threads), 0), 60);
  EXPECT_LE(DepthOf(PlanBvh(*set, 1, items, threads, 10), 0), 10 + 9);  // 2^9 > 500
}

}  // namespace
}  // namespace exphoton
