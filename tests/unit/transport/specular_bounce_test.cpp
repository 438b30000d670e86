// SPDX-License-Identifier: BSD-2-Clause
// These tests check ray differentials over specular bounces. The predicted neighbour rays must
// match neighbours that are traced, reflected and refracted themselves. No differentials may be set
// where they would not be finite.
#include <gtest/gtest.h>

#include "core/transport/specular/specular_bounce.h"
#include "tests/support/test_scene.h"

namespace exphoton {
namespace {

constexpr Real kStep = Real(1e-3);  // distance between neighbours, in radians or scene units

class SpecularFootprint : public testing::TestWithParam<LobeSet> {
 protected:
  // What becomes of a ray that meets the world, and of the neighbours beside it in x and in y.
  struct Rays {
    SpecularRay first, besideX, besideY;
  };

  // A ray from `origin` in direction d with neighbours turned about by these steps.
  std::optional<Rays> Bounce(const std::string& world, const Point3& origin, const Vector3& d,
                             const Vector3& stepX, const Vector3& stepY) {
    scene_ = LoadSceneText("WorldBegin\nMaterial \"glass\"\n" + world + "WorldEnd\n");
    RayDifferential ray(Ray{origin, Normalize(d)});
    ray.hasDifferentials = true;
    ray.xOrigin = ray.yOrigin = origin;
    ray.xDirection = Normalize(ray.d + stepX);
    ray.yDirection = Normalize(ray.d + stepY);
    const auto first = Follow(ray), x = Follow(RayDifferential(Ray{origin, ray.xDirection})),
               y = Follow(RayDifferential(Ray{origin, ray.yDirection}));
    if (!first || !x || !y) return std::nullopt;
    return Rays{*first, *x, *y};
  }
  std::optional<SpecularRay> Follow(const RayDifferential& ray) {
    const auto hit = scene_.setup->scene->Intersect(ray);
    if (!hit) return std::nullopt;
    const ShadingPoint point = MakeShadingPoint(*hit, ray, 0, TransportMode::Radiance, &arena_);
    return SampleSpecularRay(point, GetParam(), {}, 0);
  }

  // The prediction is of first order: it must leave an error of second order in the step.
  static void ExpectNear(const Ray& first, const Ray& beside, const Point3& origin,
                         const Vector3& direction) {
    const Vector3 turn = beside.d - first.d, move = beside.o - first.o;
    EXPECT_LT(Length(direction - first.d - turn), Real(.02) * Length(turn));
    EXPECT_LT(Length(origin - first.o - move), Real(.02) * Length(move));
  }
  void ExpectPredicts(const std::string& world, const Point3& origin, const Vector3& d) {
    const auto rays = Bounce(world, origin, d, Vector3(Real(.3), Real(.9), Real(-.2)) * kStep,
                             Vector3(Real(-.8), Real(.4), Real(.5)) * kStep);
    ASSERT_TRUE(rays);
    const RayDifferential& first = rays->first.ray;
    ASSERT_TRUE(first.hasDifferentials);
    ExpectNear(first, rays->besideX.ray, first.xOrigin, first.xDirection);
    ExpectNear(first, rays->besideY.ray, first.yOrigin, first.yDirection);
  }

  LoadedScene scene_;
  Arena arena_;
};

const std::string kPane =
    "Shape \"trianglemesh\" \"integer indices\" [0 1 2] \"point P\" [-9 -9 0  9 -9 0  0 9 0]\n";

TEST_P(SpecularFootprint, OnAPaneIsThatOfTheTracedNeighbour) {
  ExpectPredicts(kPane, {1, -1, 2}, {Real(-.4), Real(.2), -1});
  ExpectPredicts(kPane, {1, -1, -2}, {Real(-.3), Real(.2), 1});  // from within the glass
}

TEST_P(SpecularFootprint, OnASphereIsThatOfTheTracedNeighbour) {
  ExpectPredicts("Rotate 50 1 2 3\nShape \"sphere\"\n", {3, 1, 1}, {-1, Real(-.2), Real(-.4)});
  ExpectPredicts("Rotate 50 1 2 3\nShape \"sphere\"\n", {Real(.1), Real(.3), Real(.1)},
                 {Real(.3), Real(.8), Real(.1)});  // from the inside
}

// The pane is seen from in front of its geometric normal and from behind its shading normal.
TEST_P(SpecularFootprint, SeenFromBetweenItsNormalsIsThatOfTheTracedNeighbour) {
  const std::string normals = "\"normal N\" [.866 0 .5  .866 0 .5  .866 0 .5]\n";
  ExpectPredicts(kPane + normals, {-1, -1, 2}, {Real(.766), 0, Real(-.643)});
}

TEST_P(SpecularFootprint, IsFiniteOrNoneAtGrazingRays) {
  for (const Real slope : {Real(1e-3), Real(1e-5), Real(1e-7), Real(1e-20)}) {
    for (const Real side : {Real(1), Real(-1)}) {
      const Vector3 step(0, 0, kStep);
      const auto rays =
          Bounce(kPane, {-8, -8, side * slope}, {1, Real(.5), -side * slope}, step, step);
      if (!rays || !rays->first.ray.hasDifferentials) continue;
      EXPECT_TRUE(IsFinite(rays->first.ray.xDirection));
      EXPECT_TRUE(IsFinite(rays->first.ray.xOrigin));
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Lobes, SpecularFootprint,
                         testing::Values(LobeSet::SpecularReflection,
                                         LobeSet::SpecularTransmission));

}  // namespace
}  // namespace exphoton
