// SPDX-License-Identifier: BSD-2-Clause
// These tests require the exact answers of brute force from every accelerator, on random scenes
// with awkward content: flat boxes, equal and coplanar triangles, slivers, mixed scales, shapes and
// instances. accelerator_rays_test.cpp tests rays with extreme numbers.
#include <gtest/gtest.h>

#include <chrono>

#include "core/scene/aggregate.h"
#include "tests/support/accelerator_texts.h"
#include "tests/support/geometry_scenes.h"
#include "tests/support/test_plugin.h"

namespace exphoton {
namespace {

// Compares with brute force for many rays. Returns the number of hits, so that a test can
// require a minimum.
int CompareWithBruteForce(const PrimitiveSet& set, const std::string& accelerator, int rays,
                          std::uint64_t seed) {
  TestPlugins plugins;
  const auto oracle = plugins.MakeAccelerator(R"("bruteforce")", set);
  const auto tested = plugins.MakeAccelerator(accelerator, set);
  RandomStream random(seed);
  int hits = 0;
  for (int i = 0; i < rays; ++i) {
    const Ray ray = AwkwardRay(set, random);
    const Hit expected = oracle->Intersect(ray), found = tested->Intersect(ray);
    hits += expected.IsHit();
    EXPECT_EQ(expected.t, found.t) << accelerator << " ray " << i;
    EXPECT_EQ(expected.primitive, found.primitive) << accelerator << " ray " << i;
    EXPECT_EQ(expected.instance, found.instance) << accelerator << " ray " << i;
    EXPECT_EQ(expected.uv, found.uv);
    EXPECT_EQ(oracle->Occluded(ray), tested->Occluded(ray)) << accelerator << " ray " << i;
    // These rays end at the surface, or one rounding step before or behind it.
    for (const Real end : {NextDown(expected.t), expected.t, NextUp(expected.t)}) {
      Ray ending = ray;
      ending.tMax = std::min(end, ray.tMax);
      EXPECT_EQ(oracle->Occluded(ending), tested->Occluded(ending))
          << accelerator << " ray " << i << " to " << ending.tMax;
    }
    if (testing::Test::HasFailure()) {
      ADD_FAILURE() << "o " << ray.o.x << " " << ray.o.y << " " << ray.o.z << " d " << ray.d.x
                    << " " << ray.d.y << " " << ray.d.z << " tMax " << ray.tMax;
      break;
    }
  }
  return hits;
}

class Accelerators : public testing::TestWithParam<const char*> {};

TEST_P(Accelerators, AgreeWithBruteForceOnRandomScenes) {
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    const auto scene = RandomScene(seed);
    EXPECT_GT(CompareWithBruteForce(*scene, GetParam(), 1500, seed), 10) << "scene " << seed;
    if (HasFailure()) FAIL() << "scene " << seed;
  }
}

TEST_P(Accelerators, AgreeWithBruteForceOnShapesAndInstances) {
  TestPlugins plugins;
  for (std::uint64_t seed = 0; seed < 6; ++seed) {
    const ShapesAndInstances scene(plugins, GetParam(), seed);
    EXPECT_GT(CompareWithBruteForce(scene.Set(), GetParam(), 1500, seed), 10);
    if (HasFailure()) FAIL() << "scene " << seed;
  }
}

// Rays start on triangles whose plane is in front or behind by rounding alone. The coordinates
// range from values whose products are subnormal to values whose products overflow.
TEST_P(Accelerators, AgreeOnRaysFromSurfacesAtEveryScale) {
  TestPlugins plugins;
  for (const int exponent : {-120, -70, -45, -20, 0, 20, 41, 60, 62}) {
    RandomStream random(std::uint64_t(exponent + 200));
    const auto point = [&] {
      const auto coordinate = [&] { return std::ldexp(random.Uniform() - Real(.5), exponent); };
      const Real x = coordinate(), y = coordinate();
      return Point3(x, y, coordinate());
    };
    std::vector<std::array<Point3, 3>> triangles;
    for (int i = 0; i < 40; ++i) {
      const Point3 a = point(), b = point();
      triangles.push_back({a, b, point()});
    }
    const auto set = TriangleSet(triangles);
    const auto oracle = plugins.MakeAccelerator(R"("bruteforce")", *set);
    const auto tested = plugins.MakeAccelerator(GetParam(), *set);
    for (std::size_t i = 0; i < 3000; ++i) {
      const auto& t = triangles[i % triangles.size()];
      const Real u = random.Uniform(), b1 = u * random.Uniform(), b2 = u - b1;
      Ray ray;
      ray.o = t[0] + (t[1] - t[0]) * b1 + (t[2] - t[0]) * b2;
      const Real x = random.Uniform() - Real(.5), y = random.Uniform() - Real(.5);
      ray.d = {x, y, random.Uniform() - Real(.5)};
      const Hit expected = oracle->Intersect(ray), found = tested->Intersect(ray);
      ASSERT_EQ(expected.t, found.t) << "2^" << exponent << " ray " << i;
      ASSERT_EQ(expected.primitive, found.primitive) << "2^" << exponent << " ray " << i;
      ASSERT_EQ(oracle->Occluded(ray), tested->Occluded(ray)) << "2^" << exponent << " ray " << i;
    }
  }
}

// The layers of triangles are too close for single precision, and their ids are in no order.
TEST_P(Accelerators, AgreeOnSurfacesCloserThanSinglePrecisionResolves) {
  TestPlugins plugins;
  for (const Real gap : {Real(1e-4), Real(1e-5), Real(1e-6), Real(1e-7), Real(0)}) {
    RandomStream random(21);
    const Vector3 n = NormalizeOr({Real(.3), Real(-.5), Real(.8)}, {0, 0, 1});
    const Vector3 u = NormalizeOr(Cross(n, {1, 0, 0}), {}), v = Cross(n, u);
    std::vector<std::array<Point3, 3>> triangles;
    for (const int layer : {3, 0, 4, 1, 2}) {
      const Point3 o = n * (gap * Real(layer));
      for (int i = 0; i < 4; ++i) {
        const auto corner = [&](int k) { return o + (k % 2 ? u : -u) + (k / 2 % 2 ? v : -v) * 2; };
        triangles.push_back({corner(i), corner(i + 1), corner(i + 2)});
      }
    }
    const auto set = TriangleSet(triangles);
    const auto oracle = plugins.MakeAccelerator(R"("bruteforce")", *set);
    const auto tested = plugins.MakeAccelerator(GetParam(), *set);
    int hits = 0;
    for (int i = 0; i < 4000; ++i) {
      Ray ray;
      ray.o = RandomVector(random) * Real(4);
      ray.d = RandomVector(random) - ray.o;
      if (i % 2) ray.tMax = Between(random, Real(.999), Real(1.001));
      const Hit expected = oracle->Intersect(ray), found = tested->Intersect(ray);
      hits += expected.IsHit();
      ASSERT_EQ(expected.t, found.t) << "gap " << gap << " ray " << i;
      ASSERT_EQ(expected.primitive, found.primitive) << "gap " << gap << " ray " << i;
      ASSERT_EQ(expected.uv, found.uv);
      ASSERT_EQ(oracle->Occluded(ray), tested->Occluded(ray)) << "gap " << gap << " ray " << i;
    }
    EXPECT_GT(hits, 500);
  }
}

TEST_P(Accelerators, AreRightForNoOneAndTwoPrimitives) {
  TestPlugins plugins;
  for (int count = 0; count < 3; ++count) {
    std::vector<std::array<Point3, 3>> triangles;
    for (int i = 0; i < count; ++i) {
      const Real z = Real(i + 1);
      triangles.push_back({Point3(-1, -1, z), Point3(1, -1, z), Point3(0, 1, z)});
    }
    const auto set = TriangleSet(triangles);
    const auto tested = plugins.MakeAccelerator(GetParam(), *set);
    Ray ray;
    ray.d = {0, 0, 1};
    EXPECT_EQ(tested->Intersect(ray).IsHit(), count > 0);
    EXPECT_EQ(tested->Occluded(ray), count > 0);
    ray.d = {0, 0, -1};
    EXPECT_FALSE(tested->Intersect(ray).IsHit());
  }
}

TEST_P(Accelerators, BuildOverManyEqualOrCoplanarTrianglesInTime) {
  TestPlugins plugins;
  const auto start = std::chrono::steady_clock::now();
  constexpr int kCount = 100000;
  std::vector<std::array<Point3, 3>> equal(
      kCount, {Point3(0, 0, 1), Point3(1, 0, 1), Point3(0, 1, Real(1.5))});
  std::vector<std::array<Point3, 3>> coplanar, concentric;
  RandomStream random(7);
  for (int i = 0; i < kCount; ++i) {
    const Real x = random.Uniform(), y = random.Uniform(), e = Real(.003);
    coplanar.push_back({Point3(x, y, 1), Point3(x + e, y, 1), Point3(x, y + e, 1)});
    const Real r = (1 + random.Uniform());
    concentric.push_back({Point3(-r, -r, 1), Point3(2 * r, -r, 1), Point3(-r, 2 * r, 1)});
  }
  Ray ray;
  ray.o = {Real(.1), Real(.1), 0};
  ray.d = {0, 0, 1};
  for (const auto* triangles : {&equal, &coplanar, &concentric}) {
    const auto set = TriangleSet(*triangles);
    const auto tested = plugins.MakeAccelerator(GetParam(), *set);
    const auto oracle = plugins.MakeAccelerator(R"("bruteforce")", *set);
    const Hit hit = tested->Intersect(ray), expected = oracle->Intersect(ray);
    EXPECT_EQ(hit.primitive, expected.primitive);
    EXPECT_EQ(hit.t, expected.t);
  }
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
  EXPECT_LT(seconds.count(), 10);
}

// The scene is a room of size 1 within a world of size 1e12.
TEST_P(Accelerators, FindTheRoomInAHugeWorld) {
  auto triangles = BoxTriangles({0, 0, 0}, {1, 1, 1});
  const Real far = Real(1e12);
  triangles.push_back({Point3(-far, -2, -far), Point3(far, -2, -far), Point3(0, -2, far)});
  const auto set = TriangleSet(triangles);
  EXPECT_GT(CompareWithBruteForce(*set, GetParam(), 2000, 1), 100);
}

INSTANTIATE_TEST_SUITE_P(All, Accelerators, testing::ValuesIn(kAccelerators));

TEST(Kdtree, LimitsItsDepthWithAWarning) {
  TestPlugins plugins;
  const auto set = RandomScene(1);
  plugins.MakeAccelerator(R"("kdtree" "integer maxdepth" 1000)", *set);
  EXPECT_EQ(plugins.GetLog().WarningCount(), 1);
}

}  // namespace
}  // namespace exphoton
