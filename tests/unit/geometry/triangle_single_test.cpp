// SPDX-License-Identifier: BSD-2-Clause
// These tests compare HitInSingle with HitInDouble. Each hit of HitInSingle must be a hit of
// HitInDouble, with values within the error bound, for triangles of any size, shape and
// distance. Some rays start on the triangle.
#include <gtest/gtest.h>

#include "core/geometry/triangle_single.h"
#include "tests/support/geometry_scenes.h"

namespace exphoton {
namespace {

struct Tally {
  int sure = 0, decided = 0;
  Real largest = 0;  // largest relative difference of t
};

// Tests a ray that starts at a distance of about `away` and goes through a triangle near `center`.
// The triangle has a size of about `size` and an elongation of `aspect`. If `away` is 0, the ray
// starts on the triangle.
struct Case {
  Point3 center;
  Real size, aspect, away;
};
void TestOne(RandomStream& random, const Case& one, Tally* tally) {
  const auto [center, size, aspect, away] = one;
  const Vector3 along = RandomVector(random) * size,
                across = RandomVector(random) * (size / aspect);
  const Point3 v[3] = {center, center + along, center + along * random.Uniform() + across};
  const Real b1 = random.Uniform(), b2 = (1 - b1) * random.Uniform();
  const Point3 target = v[0] + (v[1] - v[0]) * b1 + (v[2] - v[0]) * b2;
  Ray ray;
  ray.d = NormalizeOr(RandomVector(random), {0, 0, 1});
  ray.o = target - ray.d * (away * (Real(.5) + random.Uniform()));
  const TriangleRay test(ray);
  const Real coordinates[9] = {v[0].x, v[0].y, v[0].z, v[1].x, v[1].y,
                               v[1].z, v[2].x, v[2].y, v[2].z};
  const TriangleCorners<3, 1> corners{coordinates};
  const auto hit = HitInSingle(test, corners);
  const auto decided =
      MissesTriangle(test, v[0], v[1], v[2]) ? std::nullopt : HitInDouble(test, kInfinity, corners);
  tally->decided += decided.has_value();
  if (!hit) return;
  ++tally->sure;
  ASSERT_TRUE(decided) << "size " << size << " aspect " << aspect << " away " << away;
  const Real difference = std::abs(hit->t / decided->t - 1);
  tally->largest = std::max(tally->largest, difference);
  ASSERT_LT(difference, kSingleError) << "size " << size << " aspect " << aspect;
  EXPECT_NEAR(hit->b1, decided->b1, kSingleError);
  EXPECT_NEAR(hit->b2, decided->b2, kSingleError);
  EXPECT_TRUE(hit->b1 >= 0 && hit->b2 >= 0 && hit->b1 + hit->b2 <= 1 + Gamma(4));
}

TEST(TriangleSingle, AcceptsHitsWithinItsBound) {
  RandomStream random(1);
  Tally tally;
  for (int i = 0; i < 200000; ++i) {
    const auto power = [&](Real least, Real most) {
      return std::pow(Real(10), Between(random, least, most));
    };
    const Real size = power(-6, 3), aspect = power(0, 5), away = power(-6, 6);
    TestOne(random, {RandomVector(random) * power(-3, 4), size, aspect, away}, &tally);
    if (HasFatalFailure()) return;
  }
  EXPECT_GT(tally.sure, 1000);
  EXPECT_GT(tally.largest, 0);
}

// Most triangles in pictures are of this kind.
TEST(TriangleSingle, AcceptsMostHitsOfPlainTriangles) {
  RandomStream random(2);
  Tally tally;
  for (int i = 0; i < 20000; ++i)
    TestOne(random, {RandomVector(random), Between(random, Real(.1), 1), 2, 5}, &tally);
  EXPECT_GT(tally.sure, tally.decided * 3 / 4);
}

TEST(TriangleSingle, LeavesTheTriangleThatARayStartsOnToDoubles) {
  RandomStream random(3);
  Tally tally;
  for (int i = 0; i < 20000; ++i) TestOne(random, {RandomVector(random), 1, 2, 0}, &tally);
  EXPECT_EQ(tally.sure, 0);
}

}  // namespace
}  // namespace exphoton
