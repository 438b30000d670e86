// SPDX-License-Identifier: BSD-2-Clause
// Worlds one after the other, the camera of the second dialect, and what a scene's hash is made of.
#include <gtest/gtest.h>

#include "tests/parser/parse_support.h"

namespace exphoton {
namespace {

const std::string kWorldsBegin = "Accelerator \"bruteforce\" WorldBegin\n";

TEST(SceneBuilder, ForgetsTheCoordinateSystemsOfTheWorldBefore) {
  const BuiltScene named = BuildText("CoordinateSystem \"mine\"\n" + kWorldsBegin + "WorldEnd\n" +
                                     kWorldsBegin + "CoordSysTransform \"mine\"\nWorldEnd\n");
  EXPECT_NE(named.error.find("no coordinate system \"mine\" has been named"), std::string::npos)
      << named.error;
  const BuiltScene cameras =
      BuildText("Translate 7 0 0 Camera \"perspective\"\n" + kWorldsBegin + "WorldEnd\n" +
                kWorldsBegin + "CoordSysTransform \"camera\" Shape \"sphere\"\nWorldEnd\n");
  ASSERT_EQ(cameras.error, "");
  EXPECT_NEAR(double(cameras.setups[1]->scene->WorldBounds().Center().x), 0, 1e-3);
}

TEST(SceneBuilder, MirrorsWhatTheCameraSeesAndNotTheWorldInTheDialectOfVersion2) {
  LoadOptions v2;
  v2.dialect = Dialect::V2;
  // Off the axes: mirroring x of the world would give another place than mirroring x of the camera.
  const std::string text =
      "LookAt 3 1 -5 1 2 4 .2 1 .1\nCamera \"perspective\"\n" + kWorldsBegin + "WorldEnd";
  const BuiltScene one = BuildText(text), two = BuildText(text, v2);
  ASSERT_EQ(one.error + two.error, "");
  const Point3 p(-2, 6, 9);
  const Point3 seen = one.setups[0]->camera->CameraToWorld().Inverted().ApplyPoint(p);
  const Point3 mirrored = two.setups[0]->camera->CameraToWorld().Inverted().ApplyPoint(p);
  EXPECT_LT(Distance(mirrored, Point3(-seen.x, seen.y, seen.z)), 1e-5);
}

TEST(SceneBuilder, HashesTheStringsOfParameters) {
  const auto hash = [](const std::string& name) {
    const BuiltScene built = BuildText("Film \"image\" \"string filename\" \"" + name + "\"\n" +
                                       kWorldsBegin + "WorldEnd");
    EXPECT_EQ(built.error, "");
    return built.setups.at(0)->sceneHash;
  };
  EXPECT_EQ(hash("one.exr"), hash("one.exr"));
  EXPECT_NE(hash("one.exr"), hash("two.exr"));
}

// Pilots render one scene with several integrators.
TEST(SceneBuilder, TakesTheSceneOfAKnownSetup) {
  const auto text = [](const std::string& shape) {
    return "SurfaceIntegrator \"path\"\n" + kWorldsBegin + "AttributeBegin Shape \"" + shape +
           "\" AttributeEnd\nLightSource \"point\"\nWorldEnd\n";
  };
  BuiltScene first = BuildText(text("sphere"));
  ASSERT_EQ(first.error, "");
  const auto* const scene = first.setups.at(0)->scene.get();
  first.setups[0]->integrator.reset();
  LoadOptions again;
  again.known = first.setups[0].get();
  again.integrator = "directlighting";
  const BuiltScene changed = BuildText(text("disk"), again);
  EXPECT_NE(changed.error.find("has changed"), std::string::npos) << changed.error;
  const BuiltScene second = BuildText(text("sphere"), again);
  ASSERT_EQ(second.error, "");
  EXPECT_EQ(second.setups.at(0)->scene.get(), scene);
  EXPECT_EQ(second.setups[0]->integratorName, "directlighting");
  const BuiltScene third = BuildText(text("sphere"), again);
  EXPECT_NE(third.error.find("has changed"), std::string::npos) << third.error;
}

// Blocks restore the transformation, which decides what CoordSysTransform adds to the hash.
TEST(SceneBuilder, FollowsTheBlocksOfAKnownWorld) {
  std::string blocks;  // their product would be 0
  for (const char* block : {"Attribute", "Transform", "Object"}) {
    const std::string begin = std::string(block) + "Begin";
    const std::string name = begin == "ObjectBegin" ? " \"o\"" : "";
    for (int i = 0; i < 400; ++i) blocks += begin + name + " Scale .1 .1 .1 " + block + "End\n";
  }
  const std::string text =
      "SurfaceIntegrator \"path\"\n" + kWorldsBegin +
      "AttributeBegin Translate 1 2 3 AttributeEnd CoordinateSystem \"here\"\n" + blocks +
      "CoordSysTransform \"here\" Shape \"sphere\"\nLightSource \"point\"\nWorldEnd\n";
  BuiltScene first = BuildText(text);
  ASSERT_EQ(first.error, "");
  first.setups.at(0)->integrator.reset();
  LoadOptions again;
  again.known = first.setups[0].get();
  const BuiltScene second = BuildText(text, again);
  EXPECT_EQ(second.error, "");
  EXPECT_EQ(second.setups.size(), 1u);
}

}  // namespace
}  // namespace exphoton
