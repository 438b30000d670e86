// SPDX-License-Identifier: BSD-2-Clause
// These tests check which of two hits wins: the rule itself, and each accelerator with two equal
// surfaces. The rule is written out here, because every accelerator, including brute force, takes
// it from the same header.
#include "core/scene/hit_order.h"

#include <gtest/gtest.h>

#include "tests/support/geometry_scenes.h"
#include "tests/support/test_plugin.h"

namespace exphoton {
namespace {

TEST(HitOrder, IsByDistanceThenInstanceThenPrimitive) {
  const Hit hit{1, {}, 5, 7};
  EXPECT_TRUE(Wins(Real(.5), 9, 9, hit));
  EXPECT_FALSE(Wins(2, 0, 0, hit));
  EXPECT_TRUE(Wins(1, 6, 9, hit));
  EXPECT_FALSE(Wins(1, 8, 0, hit));
  EXPECT_TRUE(Wins(1, 7, 4, hit));
  EXPECT_FALSE(Wins(1, 7, 5, hit));
  EXPECT_FALSE(Wins(1, 7, 6, hit));
}

TEST(HitOrder, WithoutAHitAsksForLessThanTheEndOfTheRay) {
  Hit none;
  none.t = 1;
  EXPECT_TRUE(Wins(Real(.5), kNoId, 0, none));
  EXPECT_FALSE(Wins(1, kNoId, 0, none));
}

// A surface that is given twice must show the material that was given first.
class EqualSurfaces : public testing::TestWithParam<const char*> {};

TEST_P(EqualSurfaces, ShowTheFirstMaterial) {
  TestPlugins plugins;
  const auto first = plugins.MakeMaterial(R"("matte")"),
             second = plugins.MakeMaterial(R"("mirror")");
  const TriangleList triangles{{Point3(-1, -1, 1), Point3(1, -1, 1), Point3(0, 1, 2)}};
  PrimitiveSet set;
  set.AddMesh(MeshOf(triangles), {first.get(), nullptr});
  set.AddMesh(MeshOf(triangles), {second.get(), nullptr});
  set.Finish();
  const auto tested = plugins.MakeAccelerator(GetParam(), set);
  RandomStream random(3);
  for (int i = 0; i < 200; ++i) {
    Ray ray;
    ray.o = RandomVector(random) * Real(.5);
    ray.d = Point3(0, 0, Real(1.5)) - ray.o;
    const Hit hit = tested->Intersect(ray);
    ASSERT_TRUE(hit.IsHit());
    ASSERT_EQ(set.Attributes(hit).material, first.get()) << "ray " << i;
  }
}

// The same rule applies to shapes and their instances.
TEST_P(EqualSurfaces, ShowTheFirstMaterialOfShapes) {
  TestPlugins plugins;
  const auto first = plugins.MakeMaterial(R"("matte")"),
             second = plugins.MakeMaterial(R"("mirror")");
  PrimitiveSet set;
  for (const Material* material : {first.get(), second.get()}) {
    ShapeGeometry disk = plugins.MakeShape(R"("disk" "float height" 1)");
    set.AddShape(std::move(std::get<std::unique_ptr<Shape>>(disk)), {material, nullptr});
  }
  set.Finish();
  const auto tested = plugins.MakeAccelerator(GetParam(), set);
  RandomStream random(3);
  for (int i = 0; i < 200; ++i) {
    Ray ray;
    ray.o = RandomVector(random) * Real(.5);
    ray.d = Point3(0, 0, 1) - ray.o;
    const Hit hit = tested->Intersect(ray);
    ASSERT_TRUE(hit.IsHit());
    ASSERT_EQ(set.Attributes(hit).material, first.get()) << "ray " << i;
  }
}

// If a shape is hit at the distance of the nearest hit so far, it wins if its id is lower.
TEST(PrimitiveSet, DecidesTiesOfShapesByTheirIdsInAnyOrder) {
  TestPlugins plugins;
  PrimitiveSet set;
  for (int i = 0; i < 2; ++i) {
    ShapeGeometry disk = plugins.MakeShape(R"("disk" "float height" 1)");
    set.AddShape(std::move(std::get<std::unique_ptr<Shape>>(disk)), {});
  }
  set.Finish();
  Ray ray;
  ray.d = {Real(.1), Real(.2), 1};
  for (const bool isForward : {true, false}) {
    Hit hit;
    for (const std::uint32_t id : {isForward ? 0u : 1u, isForward ? 1u : 0u})
      set.Intersect(id, TraceRay(ray), &hit);
    ASSERT_TRUE(hit.IsHit());
    EXPECT_EQ(hit.primitive, 0u) << isForward;
  }
}

INSTANTIATE_TEST_SUITE_P(Accelerators, EqualSurfaces,
                         testing::Values(
#ifdef EXPHOTON_EMBREE
                             R"("embree")",
#endif
                             R"("bruteforce")", R"("kdtree")", R"("bvh")",
                             R"("bvh" "string vectors" "portable")"));

}  // namespace
}  // namespace exphoton
