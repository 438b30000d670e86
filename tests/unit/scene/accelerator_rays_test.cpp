// SPDX-License-Identifier: BSD-2-Clause
// These tests trace rays with extreme numbers: from afar, along axes, of any length, or invalid.
// Every accelerator must give the answers of brute force, or of a closed form.
#include <gtest/gtest.h>

#include <chrono>

#include "core/scene/aggregate.h"
#include "tests/support/accelerator_texts.h"
#include "tests/support/geometry_scenes.h"
#include "tests/support/test_plugin.h"

namespace exphoton {
namespace {

class AcceleratorRays : public testing::TestWithParam<const char*> {};

// Products of the ray's numbers overflow, and unused child slots of a node have infinite bounds.
// The traversal must still end with the right answer.
TEST_P(AcceleratorRays, EndForRaysFromFarAwayWithShortDirections) {
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

// Rays that run mainly across a triangle hit it at the right distance, however large it is, as long
// as the differences of its coordinates are finite (docs/development/robustness.md).
TEST_P(AcceleratorRays, MeetATriangleAsLargeAsTheirNumbersAllow) {
  TestPlugins plugins;
  for (const int exponent : {20, 40, 60, 61, 62, 63, 64, 80, 100, 120, 124, 125, 126, 127}) {
    const Real far = std::ldexp(Real(1), exponent);
    const auto set =
        TriangleSet({{Point3(-far, 2, -far), Point3(far, 2, -far), Point3(0, 2, far)}});
    const auto tested = plugins.MakeAccelerator(GetParam(), *set);
    for (int i = 0; i < 100; ++i) {
      Ray ray;
      // Powers of two, so that nothing is rounded beside the large numbers.
      ray.o = {0, Real(i % 4) / 2, 0};
      ray.d = {Real(i % 5 - 2) / 8, 1, Real(i % 3 - 1) / 4};
      const Real t = (2 - ray.o.y) / ray.d.y;
      const Hit hit = tested->Intersect(ray);
      ASSERT_TRUE(hit.IsHit()) << "2^" << exponent;
      ASSERT_NEAR(double(hit.t / t), 1, 1e-5) << "2^" << exponent;
    }
  }
}

// The lengths go down to subnormal numbers, which are few.
TEST_P(AcceleratorRays, AgreeForDirectionsOfAnyLength) {
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

TEST_P(AcceleratorRays, MeetTheBoxAlongEveryAxisWithBothZeros) {
  TestPlugins plugins;
  const auto set = TriangleSet(BoxTriangles({0, 0, 0}, {1, 1, 1}));
  const auto tested = plugins.MakeAccelerator(GetParam(), *set);
  int hits = 0;
  for (int axis = 0; axis < 3; ++axis) {
    for (int side = 0; side < 2; ++side) {
      for (int zeros = 0; zeros < 4; ++zeros) {
        // One ray goes inwards from the middle of a face. The other ray starts outside and runs in
        // the plane of a face.
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

TEST_P(AcceleratorRays, AnswerNothingToRaysThatAreNone) {
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

// The rounding of a ray's numbers is far larger than the gaps between cells. A ray may hit a
// triangle although the split planes seem to separate them. Vertices lie on the kd-tree's
// split planes.
TEST_P(AcceleratorRays, AgreeThroughVerticesSeenFromAfar) {
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

INSTANTIATE_TEST_SUITE_P(All, AcceleratorRays, testing::ValuesIn(kAccelerators));

}  // namespace
}  // namespace exphoton
