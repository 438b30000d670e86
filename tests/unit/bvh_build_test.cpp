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

}  // namespace
}  // namespace exphoton
