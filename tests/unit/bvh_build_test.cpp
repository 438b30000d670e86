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
  const auto oracle = plugins.MakeAccelerator(R"("bruteforce")", *set);
  const auto tested = plugins.MakeAccelerator(R"("bvh")", *set, 2);
  RandomStream random(5);
  int triangles = 0, spheres = 0;
  for (int i = 0; i < 1000; ++i) {
    const Ray ray = AwkwardRay(*set, random);
    const Hit expected = oracle->Intersect(ray), found = tested->Intersect(ray);
    EXPECT_EQ(expected.t, found.t);
    ASSERT_EQ(expected.primitive, found.primitive) << "ray " << i;
    ASSERT_EQ(oracle->Occluded(ray), tested->Occluded(ray)) << "ray " << i;
    if (expected.IsHit()) ++(expected.primitive < set->TriangleCount() ? triangles : spheres);
  }
  EXPECT_GT(triangles, 100);
  EXPECT_GT(spheres, 10);
}

}  // namespace
}  // namespace exphoton
