// SPDX-License-Identifier: BSD-2-Clause
// These tests check the place that a shading point gives to the choice of lights.
#include <gtest/gtest.h>

#include "core/transport/shading_point.h"
#include "tests/support/test_scene.h"

namespace exphoton {
namespace {

// Returns the receiver where a ray along d meets a plane with the geometric normal +z or -z.
LightReceiver ReceiverAt(const std::string& material, const Vector3& d) {
  const LoadedScene scene = LoadSceneText(
      "WorldBegin\nMaterial " + material +
      "\nShape \"trianglemesh\" \"integer indices\" [0 1 2] \"point P\" [-9 -9 0 9 -9 0 0 9 0] "
      "\"normal N\" [.6 0 .8 .6 0 .8 .6 0 .8]\nWorldEnd\n");
  const RayDifferential ray(Ray{Point3() - d, d});
  const auto hit = scene.setup->scene->Intersect(ray);
  EXPECT_TRUE(hit);
  Arena arena;
  return MakeShadingPoint(*hit, ray, 0, TransportMode::Radiance, &arena).Receiver();
}

TEST(LightReceiver, OfASurfaceThatReflectsIsOnTheSideOfTheViewer) {
  for (const Real side : {Real(1), Real(-1)}) {
    const LightReceiver receiver = ReceiverAt("\"matte\"", {0, 0, -side});
    EXPECT_EQ(receiver.p, Point3());
    EXPECT_EQ(receiver.n, Normal3(0, 0, side));
    EXPECT_NEAR(double(std::abs(receiver.ns.x)), .6, 1e-6);
    EXPECT_NEAR(double(std::abs(receiver.ns.z)), .8, 1e-6);
  }
}

TEST(LightReceiver, OfASurfaceThatTransmitsIsOnBothSides) {
  const LightReceiver receiver = ReceiverAt("\"translucent\"", {0, 0, -1});
  EXPECT_EQ(receiver.n, Normal3());
  EXPECT_NEAR(double(std::abs(receiver.ns.z)), .8, 1e-6);
}

}  // namespace
}  // namespace exphoton
