// SPDX-License-Identifier: BSD-2-Clause
// Every accelerator answers exactly as brute force does, on random scenes with everything that is
// awkward: flat boxes, equal and coplanar triangles, slivers, mixed scales, shapes and instances.
#include <gtest/gtest.h>

#include <chrono>

#include "core/scene/aggregate.h"
#include "tests/support/geometry_scenes.h"
#include "tests/support/test_plugin.h"

namespace exphoton {
namespace {

const char* const kAccelerators[] = {
    R"("kdtree")",
    R"("kdtree" "integer maxdepth" 3)",
    R"("kdtree" "integer maxprims" 8 "float emptybonus" 0 "integer intersectcost" 1)",
    R"("bvh")",
    R"("bvh" "string vectors" "portable")",
    R"("bvh" "string vectors" "avx2")",
    R"("bvh" "integer maxprims" 2)",
    R"("bvh" "integer maxprims" 20)",
};

// Compares with brute force for many rays; returns the number of hits, so that a test can ask for
// some.
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
    // Rays that end at the surface, or by rounding alone before or behind it.
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

// Rays from points on triangles, whose own plane is ahead or behind by rounding alone, with
// coordinates from those whose products are subnormal to those whose products overflow.
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

// Layers that single precision does not tell apart, in any order of their ids.
TEST_P(Accelerators, AgreeOnLayersCloserThanSinglePrecisionTells) {
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

// Products of what a ray is made of overflow, with infinite bounds of children that there are not.
TEST_P(Accelerators, EndForRaysFromFarAwayWithShortDirections) {
  TestPlugins plugins;
  const Real tiny = std::ldexp(Real(1), -117), far = std::ldexp(Real(1), 102);
  std::vector<std::array<Point3, 3>> triangles;
  for (const Real x : {Real(-1), Real(0), Real(1)})
    triangles.push_back({Point3(x, -1, 0), Point3(x, 1, tiny), Point3(x + Real(.5), 0, 1)});
  const auto set = TriangleSet(triangles);
  const auto oracle = plugins.MakeAccelerator(R"("bruteforce")", *set);
  const auto tested = plugins.MakeAccelerator(GetParam(), *set);
  for (int signs = 0; signs < 64; ++signs) {
    for (const Real distance : {Real(0), Real(1), far, std::numeric_limits<Real>::max()}) {
      const auto sign = [&](int bit) { return signs >> bit & 1 ? Real(-1) : Real(1); };
      Ray ray;
      ray.o = {sign(0) * tiny, sign(1) * distance, sign(2) * distance / 1024};
      ray.d = {sign(3) * 2 * tiny, sign(4) * tiny, sign(5) * tiny};
      const Hit expected = oracle->Intersect(ray), found = tested->Intersect(ray);
      EXPECT_EQ(expected.t, found.t) << signs << " at " << distance;
      EXPECT_EQ(oracle->Occluded(ray), tested->Occluded(ray)) << signs << " at " << distance;
    }
  }
}

// Down to subnormal numbers, of which there are few.
TEST_P(Accelerators, AgreeForDirectionsOfAnyLength) {
  TestPlugins plugins;
  for (const int exponent : {-148, -142, -137, -130, -126, -110, -99, -60, 60, 100, 126}) {
    const Real size = std::ldexp(Real(1), std::min(exponent + 5, 49));
    RandomStream random(std::uint64_t(exponent + 200));
    const auto coordinate = [&] { return random.Uniform() - Real(.5); };
    std::vector<std::array<Point3, 3>> triangles(20);
    for (auto& triangle : triangles)
      for (Point3& p : triangle) {
        const Real x = coordinate() * size, y = coordinate() * size;
        p = {x, y, coordinate() * size};
      }
    const auto set = TriangleSet(triangles);
    const auto oracle = plugins.MakeAccelerator(R"("bruteforce")", *set);
    const auto tested = plugins.MakeAccelerator(GetParam(), *set);
    for (int i = 0; i < 2000; ++i) {
      Ray ray;
      for (int axis = 0; axis < 3; ++axis) {
        ray.o[axis] = i % 3 == 0 ? Real(0) : coordinate() * size;
        const Real d = std::ldexp(coordinate() * 2, exponent);
        ray.d[axis] = random.Uniform() < Real(.3) ? d / 65536 : d;
      }
      const Hit expected = oracle->Intersect(ray), found = tested->Intersect(ray);
      ASSERT_EQ(expected.t, found.t) << "2^" << exponent << " ray " << i;
      ASSERT_EQ(oracle->Occluded(ray), tested->Occluded(ray)) << "2^" << exponent << " ray " << i;
    }
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

TEST_P(Accelerators, MeetTheBoxAlongEveryAxisWithBothZeros) {
  TestPlugins plugins;
  const auto set = TriangleSet(BoxTriangles({0, 0, 0}, {1, 1, 1}));
  const auto tested = plugins.MakeAccelerator(GetParam(), *set);
  int hits = 0;
  for (int axis = 0; axis < 3; ++axis) {
    for (int side = 0; side < 2; ++side) {
      for (int zeros = 0; zeros < 4; ++zeros) {
        // From the middle of a face inwards, and from outside along a face's own plane.
        Ray ray;
        ray.o = Point3(Real(.5), Real(.5), Real(.5));
        ray.o[axis] = Real(side);
        ray.d[axis] = side ? Real(-1) : Real(1);
        ray.d[(axis + 1) % 3] = zeros & 1 ? -Real(0) : Real(0);
        ray.d[(axis + 2) % 3] = zeros & 2 ? -Real(0) : Real(0);
        const Hit hit = tested->Intersect(ray);
        hits += hit.IsHit() && hit.t == 1;
        Ray along = ray;
        along.o[axis] = side ? Real(3) : Real(-2);
        along.o[(axis + 1) % 3] = Real(side);
        const Hit edge = tested->Intersect(along);
        EXPECT_TRUE(edge.IsHit()) << "axis " << axis << " side " << side << " zeros " << zeros;
      }
    }
  }
  EXPECT_EQ(hits, 24);
}

TEST_P(Accelerators, AnswerNothingToRaysThatAreNone) {
  TestPlugins plugins;
  const auto set = RandomScene(3);
  const auto tested = plugins.MakeAccelerator(GetParam(), *set);
  const Real nan = std::numeric_limits<Real>::quiet_NaN();
  Ray good;
  good.o = {0, 0, -5};
  good.d = {0, 0, 1};
  std::vector<Ray> rays;
  for (int axis = 0; axis < 3; ++axis) {
    for (const Real bad : {nan, kInfinity, -kInfinity}) {
      rays.push_back(good);
      rays.back().o[axis] = bad;
      rays.push_back(good);
      rays.back().d[axis] = bad;
    }
  }
  rays.push_back(good);
  rays.back().d = {0, -Real(0), 0};
  for (const Real tMax : {nan, Real(0), Real(-1)}) {
    rays.push_back(good);
    rays.back().tMax = tMax;
  }
  for (const Ray& ray : rays) {
    EXPECT_FALSE(tested->Intersect(ray).IsHit());
    EXPECT_FALSE(tested->Occluded(ray));
  }
}

// A room of size 1 within a world of size 1e12.
TEST_P(Accelerators, FindTheRoomInAHugeWorld) {
  auto triangles = BoxTriangles({0, 0, 0}, {1, 1, 1});
  const Real far = Real(1e12);
  triangles.push_back({Point3(-far, -2, -far), Point3(far, -2, -far), Point3(0, -2, far)});
  const auto set = TriangleSet(triangles);
  EXPECT_GT(CompareWithBruteForce(*set, GetParam(), 2000, 1), 100);
}

// A ray's numbers are rounded to far more than the gaps between cells: it meets what the planes
// between them seem to part it from. Vertices lie where the kd-tree splits.
TEST_P(Accelerators, AgreeThroughVerticesSeenFromAfar) {
  TestPlugins plugins;
  constexpr int kSide = 12;
  RandomStream random(8);
  std::vector<Point3> vertices;
  for (int y = 0; y <= kSide; ++y)
    for (int x = 0; x <= kSide; ++x)
      vertices.push_back({Real(x) / kSide, Real(y) / kSide, random.Uniform() / kSide});
  TriangleList triangles;
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x) {
      const auto at = [&](int dx, int dy) {
        return vertices[std::size_t((y + dy) * (kSide + 1) + x + dx)];
      };
      triangles.push_back({at(0, 0), at(1, 0), at(1, 1)});
      triangles.push_back({at(0, 0), at(1, 1), at(0, 1)});
    }
  }
  const auto set = TriangleSet(triangles);
  const auto oracle = plugins.MakeAccelerator(R"("bruteforce")", *set);
  const auto tested = plugins.MakeAccelerator(GetParam(), *set);
  for (int i = 0; i < 20000; ++i) {
    const Vector3 slant = i % 2 ? Vector3(0, 0, 1) * Real(.02) : Vector3(0, 0, 1);
    const Vector3 from = RandomVector(random);
    Ray ray;
    ray.o = Point3() + Vector3(from.x, from.y, 0) * Real(1e4) + slant * Real(1e4);
    ray.d = vertices[std::size_t(random.Uniform() * Real(vertices.size()))] - ray.o;
    const Hit expected = oracle->Intersect(ray), found = tested->Intersect(ray);
    ASSERT_EQ(expected.t, found.t) << "ray " << i;
    ASSERT_EQ(expected.primitive, found.primitive) << "ray " << i;
    ASSERT_EQ(oracle->Occluded(ray), tested->Occluded(ray)) << "ray " << i;
  }
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
