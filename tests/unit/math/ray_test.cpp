// SPDX-License-Identifier: BSD-2-Clause
// These tests check rays that leave surfaces: RaySpawner must make the same rays as SpawnRay.
#include "core/geometry/ray.h"

#include <gtest/gtest.h>

#include "core/math/sampling/random.h"
#include "core/math/sampling/sampling.h"

namespace exphoton {
namespace {

TEST(SpawnRayTo, KeepsTheTimeOfItsOrigin) {
  SurfacePoint from, to;
  from.time = Real(.75);
  to.p = {1, 2, 3};
  EXPECT_EQ(SpawnRayTo(from, to).time, Real(.75));
  EXPECT_EQ(SpawnRay(from, {0, 0, 1}).time, Real(.75));
}

TEST(RaySpawner, MakesTheRaysThatAreSpawnedOneByOne) {
  RandomStream random(3);
  const auto direction = [&] { return SampleUniformSphere({random.Uniform(), random.Uniform()}); };
  for (int i = 0; i < 100; ++i) {
    SurfacePoint point;
    point.p = Point3(0, 0, 0) + direction() * Real(10);
    point.pError = Abs(direction()) * Real(1e-6);
    if (i % 10) point.ng = direction();  // otherwise the point is on no surface
    point.time = random.Uniform();
    const RaySpawner spawner(point);
    for (int j = 0; j < 10; ++j) {
      const Vector3 w = direction();
      const Ray expected = SpawnRay(point, w), ray = spawner.Spawn(w);
      EXPECT_EQ(ray.o, expected.o);
      EXPECT_EQ(ray.d, expected.d);
      EXPECT_EQ(ray.tMax, expected.tMax);
      EXPECT_EQ(ray.time, expected.time);
    }
  }
}

// The plane through the origin clears the error box on the side of w, and not by much.
TEST(SpawnRay, StartsJustOutsideTheErrorBoxOnTheSideOfItsDirection) {
  RandomStream random(4);
  const auto direction = [&] { return SampleUniformSphere({random.Uniform(), random.Uniform()}); };
  for (int i = 0; i < 500; ++i) {
    SurfacePoint point;
    point.p = direction() * Real(3);
    if (i % 3 == 0) point.p[i % 2] = 0;
    point.pError = Abs(direction()) * Real(1e-4);
    point.ng = direction();
    const Vector3 w = direction();
    const Ray ray = SpawnRay(point, w);
    EXPECT_EQ(ray.d, w);
    EXPECT_EQ(ray.tMax, kInfinity);
    const double side = Dot(w, point.ng) < 0 ? -1 : 1;
    double reach = 0, moved = 0, aside = 0;
    for (int axis = 0; axis < 3; ++axis) {
      const double n = double(point.ng[axis]), step = double(ray.o[axis]) - double(point.p[axis]);
      reach += std::abs(n) * double(point.pError[axis]);
      moved += side * n * step;
    }
    for (int axis = 0; axis < 3; ++axis)
      aside += std::abs(double(ray.o[axis]) - double(point.p[axis]) -
                        side * double(point.ng[axis]) * moved);
    EXPECT_GE(moved, reach);
    EXPECT_LT(moved, reach * 1.001 + 2e-6);
    EXPECT_LT(aside, 2e-6);
  }
}

// Each axis moves at least to the next value away from the surface; from 0 by a part of the offset.
TEST(SpawnRay, MovesEachAxisAtLeastOneStep) {
  SurfacePoint point;
  point.p = {1, -2, 0};
  point.ng = {Real(.6), Real(.64), Real(.48)};
  point.pError = {Real(1e-20), Real(1e-20), Real(1e-20)};
  const Point3 front = SpawnRay(point, point.ng).o, back = SpawnRay(point, -point.ng).o;
  EXPECT_EQ(front.x, NextUp(1));
  EXPECT_EQ(front.y, NextUp(-2));
  EXPECT_EQ(back.x, NextDown(1));
  EXPECT_EQ(back.y, NextDown(-2));
  EXPECT_GT(front.z, Real(1e-21));
  EXPECT_EQ(front.z, -back.z);
  point.pError = {};
  EXPECT_EQ(SpawnRay(point, point.ng).o, point.p);
  // The offset and the coordinate cancel exactly.
  SurfacePoint cancels;
  cancels.ng = {1, 0, 0};
  cancels.pError = {Real(.5), 0, 0};
  cancels.p = {-(Real(.5) * (1 + Gamma(8))), 0, 0};
  EXPECT_EQ(SpawnRay(cancels, {1, 0, 0}).o.x, -cancels.p.x * kMachineEpsilon);
}

TEST(SpawnRayTo, EndsOutsideTheErrorBoxOfItsTarget) {
  RandomStream random(5);
  const auto direction = [&] { return SampleUniformSphere({random.Uniform(), random.Uniform()}); };
  for (int i = 0; i < 200; ++i) {
    SurfacePoint from, to;
    from.p = direction(), to.p = direction() * Real(5);
    from.ng = direction(), to.ng = direction();
    from.pError = Abs(direction()) * Real(1e-5), to.pError = Abs(direction()) * Real(1e-4);
    const Ray ray = SpawnRayTo(from, to);
    const Vector3 between = to.p - from.p;
    EXPECT_EQ(ray.o, OffsetRayOrigin(from, between));
    EXPECT_EQ(ray.tMax, 1 - Gamma(4));
    const double side = Dot(between, to.ng) > 0 ? -1 : 1;
    double reach = 0, rest = 0;
    for (int axis = 0; axis < 3; ++axis) {
      const double n = double(to.ng[axis]);
      const double end = double(ray.o[axis]) + double(ray.d[axis]) * double(ray.tMax);
      reach += std::abs(n) * double(to.pError[axis]);
      rest += side * n * (end - double(to.p[axis]));
    }
    EXPECT_GT(rest, reach);
    EXPECT_LT(rest, reach + 1e-5);
  }
}

}  // namespace
}  // namespace exphoton
