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

// A crowd of small triangles with spheres among them, far more than one piece has.
std::unique_ptr<PrimitiveSet> LargeSet(TestPlugins& plugins) {
  RandomStream random(31);
  TriangleList triangles;
  for (int i = 0; i < 30000; ++i) {
    const Point3 p = Point3() + RandomVector(random) * 10;
    triangles.push_back(
        {p, p + RandomVector(random) * Real(.2), p + RandomVector(random) * Real(.2)});
  }
  auto set = std::make_unique<PrimitiveSet>();
  set->AddMesh(MeshOf(triangles), {});
  for (int i = 0; i < 600; ++i) {
    auto shape = plugins.MakeShape(R"("sphere" "float radius" .1)",
                                   Transform::Translate(RandomVector(random) * 10));
    set->AddShape(std::move(std::get<std::unique_ptr<Shape>>(shape)), {});
  }
  set->Finish();
  return set;
}

TEST(BvhBuild, GivesTheSameBytesWithAnyNumberOfThreads) {
  TestPlugins plugins;
  const auto set = LargeSet(plugins);
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
  const auto set = LargeSet(plugins);
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
