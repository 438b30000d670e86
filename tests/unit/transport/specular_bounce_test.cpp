// SPDX-License-Identifier: BSD-2-Clause
// These tests check ray differentials over specular bounces. The predicted neighbour rays must
// match neighbours that are traced, reflected and refracted themselves. No differentials may be set
// where they would not be finite.
#include <gtest/gtest.h>

#include "core/transport/specular_bounce.h"
#include "tests/support/test_scene.h"

namespace exphoton {
namespace {

constexpr Real kStep = Real(1e-3);  // distance between neighbours, in radians or scene units

class SpecularFootprint : public testing::TestWithParam<LobeSet> {
 protected:
  // Pair holds the specular rays of a ray and of its neighbour.
  struct Pair {
    SpecularRay first, neighbour;
  };

  // Traces a ray from `origin` in direction d, and a neighbour whose direction is turned by `step`.
  std::optional<Pair> Bounce(const std::string& world, const Point3& origin, const Vector3& d,
                             const Vector3& step) {
    scene_ = LoadSceneText("WorldBegin\nMaterial \"glass\"\n" + world + "WorldEnd\n");
    const Vector3 turned = Normalize(Normalize(d) + step);
    RayDifferential ray(Ray{origin, Normalize(d)}), beside(Ray{origin, turned});
    ray.hasDifferentials = true;
    ray.xOrigin = ray.yOrigin = origin;
    ray.xDirection = ray.yDirection = turned;
    const auto a = Follow(ray), b = Follow(beside);
    if (!a || !b) return std::nullopt;
    return Pair{*a, *b};
  }
  std::optional<SpecularRay> Follow(const RayDifferential& ray) {
    const auto hit = scene_.setup->scene->Intersect(ray);
    if (!hit) return std::nullopt;
    const ShadingPoint point = MakeShadingPoint(*hit, ray, 0, TransportMode::Radiance, &arena_);
    return SampleSpecularRay(point, GetParam(), {}, 0);
  }

  // The prediction is of first order, so its error must be of second order in the step.
  void ExpectPredicts(const std::string& world, const Point3& origin, const Vector3& d) {
    const auto pair = Bounce(world, origin, d, Vector3(Real(.3), Real(.9), Real(-.2)) * kStep);
    ASSERT_TRUE(pair);
    ASSERT_TRUE(pair->first.ray.hasDifferentials);
    const Vector3 direction = pair->neighbour.ray.d - pair->first.ray.d;
    const Vector3 predicted = pair->first.ray.xDirection - pair->first.ray.d;
    EXPECT_LT(Length(predicted - direction), Real(.02) * Length(direction));
    const Vector3 place = pair->neighbour.ray.o - pair->first.ray.o;
    const Vector3 predictedPlace = pair->first.ray.xOrigin - pair->first.ray.o;
    EXPECT_LT(Length(predictedPlace - place), Real(.02) * Length(place));
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

TEST_P(SpecularFootprint, IsFiniteOrNoneAtGrazingRays) {
  for (const Real slope : {Real(1e-3), Real(1e-5), Real(1e-7), Real(1e-20)}) {
    for (const Real side : {Real(1), Real(-1)}) {
      const auto pair =
          Bounce(kPane, {-8, -8, side * slope}, {1, Real(.5), -side * slope}, Vector3(0, 0, kStep));
      if (!pair || !pair->first.ray.hasDifferentials) continue;
      EXPECT_TRUE(IsFinite(pair->first.ray.xDirection));
      EXPECT_TRUE(IsFinite(pair->first.ray.xOrigin));
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Lobes, SpecularFootprint,
                         testing::Values(LobeSet::SpecularReflection,
                                         LobeSet::SpecularTransmission));

}  // namespace
}  // namespace exphoton
