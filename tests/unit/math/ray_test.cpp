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

}  // namespace
}  // namespace exphoton
