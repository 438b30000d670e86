// SPDX-License-Identifier: BSD-2-Clause
// The hierarchy of a large set: made in pieces by threads, the same whatever their number, and with
// the hits of brute force.
#include <gtest/gtest.h>

#include <cstring>

#include "accelerators/bvh/bvh_build.h"
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

// Each triangle is three quarters as large as the one before, about the same corner: every split by
// surface takes off the largest one.
TEST(BvhBuild, OfNestedTrianglesIsNotTooDeep) {
  TriangleList triangles;
  Real size = Real(1e18);
  for (int i = 0; i < 250; ++i, size *= Real(.75))
    triangles.push_back({Point3(size, 0, size), Point3(0, size, size), Point3(size, size, 0)});
  const auto set = TriangleSet(triangles);
  ThreadPool threads(1);
  const int depth = BuildBvh(*set, 2, threads).depth;
  EXPECT_GT(depth, 10);  // else it is no hard case
  EXPECT_LE(depth, kBvhMaxDepth);
}

}  // namespace
}  // namespace exphoton
