// SPDX-License-Identifier: BSD-2-Clause
// These tests compare accelerator "embree" with brute force: the hits are the same, except for
// the few rays that touch an edge. If the program was built without Embree, the error message
// must give advice.
#include <gtest/gtest.h>

#include "core/scene/aggregate.h"
#include "tests/support/geometry_scenes.h"
#include "tests/support/test_plugin.h"

namespace exphoton {
namespace {

#if defined(EXPHOTON_EMBREE)

// Compares with brute force for rays between random points, which rarely touch an edge.
void ExpectTheSameHits(const PrimitiveSet& set, std::uint64_t seed) {
  TestPlugins plugins;
  const auto oracle = plugins.MakeAccelerator(R"("bruteforce")", set);
  const auto tested = plugins.MakeAccelerator(R"("embree")", set);
  RandomStream random(seed);
  const Bounds3 world = set.WorldBounds();
  const auto place = [&] {
    const Vector3 part(random.Uniform(), random.Uniform(), random.Uniform()),
        size = world.Diagonal();
    return world.min + Vector3(part.x * size.x, part.y * size.y, part.z * size.z);
  };
  constexpr int kRays = 2000;
  int hits = 0, differing = 0;
  for (int i = 0; i < kRays; ++i) {
    Ray ray;
    ray.o = place();
    ray.d = place() - ray.o;
    if (i % 4 == 0) ray.tMax = 2 * random.Uniform();
    const Hit expected = oracle->Intersect(ray), found = tested->Intersect(ray);
    hits += expected.IsHit();
    differing +=
        expected.IsHit() != found.IsHit() || oracle->Occluded(ray) != tested->Occluded(ray);
    if (!expected.IsHit() || !found.IsHit()) continue;
    differing += !(std::abs(found.t - expected.t) <= Real(1e-5) * expected.t);
    // If two surfaces have the same distance, either may be found. On the same surface, the
    // parameters must be equal.
    if (found.primitive == expected.primitive && found.instance == expected.instance) {
      EXPECT_EQ(found.uv, expected.uv);
    }
  }
  EXPECT_GT(hits, 0);
  EXPECT_LE(differing, 4) << "of " << kRays;
}

TEST(Embree, FindsTheHitsOfBruteForceOnTriangles) {
  for (const std::uint64_t seed : {3, 4, 5}) {
    TriangleList triangles = SphereTriangles({0, 0, 0}, 20, 30);
    const TriangleList box = BoxTriangles({-2, -2, -2}, {2, 2, 2});
    triangles.insert(triangles.end(), box.begin(), box.end());
    ExpectTheSameHits(*TriangleSet(triangles), seed);
  }
}

TEST(Embree, FindsTheHitsOfBruteForceOnShapesAndInstances) {
  TestPlugins plugins;
  for (std::uint64_t seed = 0; seed < 3; ++seed) {
    const ShapesAndInstances scene(plugins, R"("bvh")", seed);
    ExpectTheSameHits(scene.Set(), seed);
  }
}

// The worlds lie on both sides of the sizes at which volumes underflow and squares overflow in
// single precision.
TEST(Embree, DoesNotMissEverythingInHugeAndTinyWorlds) {
  TestPlugins plugins;
  for (const int exponent : {-100, -60, -40, 40, 62, 64, 80, 100}) {
    const Real size = std::ldexp(Real(1), exponent);
    TriangleList triangles = SphereTriangles({0, 0, 0}, 10, 16);
    for (auto& triangle : triangles)
      for (Point3& p : triangle) p = p * size;
    ExpectTheSameHits(*TriangleSet(triangles), 7);
    PrimitiveSet shapes;
    for (const Real x : {Real(-2), Real(0), Real(2)}) {
      const auto toWorld = Transform::Translate({x * size, 0, 0}) *
                           *Transform::Scale(double(size), double(size), double(size));
      ShapeGeometry sphere = plugins.MakeShape(R"("sphere")", toWorld);
      shapes.AddShape(
          std::shared_ptr<const Shape>(std::move(std::get<std::unique_ptr<Shape>>(sphere))), {});
    }
    shapes.Finish();
    ExpectTheSameHits(shapes, 8);
  }
}

TEST(Embree, TracesDirectionsOfAnyLength) {
  TestPlugins plugins;
  const auto set = TriangleSet(BoxTriangles({-1, -1, -1}, {1, 1, 1}));
  const auto tested = plugins.MakeAccelerator(R"("embree")", *set);
  for (const int exponent : {-110, -70, 0, 70, 110}) {
    Ray ray;
    ray.o = {Real(.1), Real(.2), 0};
    ray.d = Vector3(Real(.3), Real(.2), 1) * std::ldexp(Real(1), exponent);
    EXPECT_TRUE(tested->Intersect(ray).IsHit()) << exponent;
    EXPECT_TRUE(tested->Occluded(ray)) << exponent;
    ray.tMax = std::ldexp(Real(.9), -exponent);
    EXPECT_FALSE(tested->Occluded(ray)) << exponent;
    ray.tMax = std::ldexp(Real(1.1), -exponent);
    EXPECT_TRUE(tested->Occluded(ray)) << exponent;
  }
}

TEST(Embree, NeverMeetsTheSurfaceThatARayLeaves) {
  TestPlugins plugins;
  const auto set = TriangleSet(SphereTriangles({1, 2, 3}, 40, 60));
  const auto tested = plugins.MakeAccelerator(R"("embree")", *set);
  RandomStream random(9);
  for (int i = 0; i < 5000; ++i) {
    Ray ray;
    ray.o = {1, 2, 3};
    ray.d = RandomVector(random);
    const Hit hit = tested->Intersect(ray);
    ASSERT_TRUE(hit.IsHit());
    const SurfacePoint point = set->Point(ray, hit);
    // A ray that leaves a convex body outwards hits nothing. A hit would be on the surface that
    // the ray leaves.
    EXPECT_FALSE(tested->Occluded(SpawnRay(point, ray.d)));
  }
}

TEST(Embree, IsRightForNothingAndForRaysThatAreNone) {
  TestPlugins plugins;
  const auto nothing = TriangleSet({});
  const auto empty = plugins.MakeAccelerator(R"("embree")", *nothing);
  Ray ray;
  ray.d = {0, 0, 1};
  EXPECT_FALSE(empty->Intersect(ray).IsHit());
  EXPECT_FALSE(empty->Occluded(ray));
  const auto box = TriangleSet(BoxTriangles({-1, -1, -1}, {1, 1, 1}));
  const auto tested = plugins.MakeAccelerator(R"("embree")", *box);
  EXPECT_TRUE(tested->Intersect(ray).IsHit());
  ray.d = {};
  EXPECT_FALSE(tested->Intersect(ray).IsHit());
  EXPECT_FALSE(tested->Occluded(ray));
}

#else

TEST(Embree, SaysHowToGetItWhereItIsMissing) {
  TestPlugins plugins;
  const auto set = TriangleSet(BoxTriangles({-1, -1, -1}, {1, 1, 1}));
  try {
    plugins.MakeAccelerator(R"("embree")", *set);
    FAIL() << "made something";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("libembree-dev"), std::string::npos) << error.what();
  }
}

#endif

}  // namespace
}  // namespace exphoton
