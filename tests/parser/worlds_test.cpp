// SPDX-License-Identifier: BSD-2-Clause
// Worlds one after the other, the camera of the second dialect, and what a scene's hash is made of.
#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

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

// Pilots render one scene with several integrators. The file is not read again.
TEST(SceneBuilder, TakesTheSceneOfAKnownSetup) {
  BuiltScene first = BuildText("SurfaceIntegrator \"path\"\n" + kWorldsBegin +
                               "AttributeBegin Shape \"sphere\" AttributeEnd\n"
                               "LightSource \"point\"\nWorldEnd\n");
  ASSERT_EQ(first.error, "");
  RenderSetup& known = *first.setups.at(0);
  const auto* const scene = known.scene.get();
  LoadOptions again;
  again.known = &known;
  again.integrator = "directlighting";
  const BuiltScene second = BuildText("no scene", again);
  ASSERT_EQ(second.error, "");
  const RenderSetup& setup = *second.setups.at(0);
  EXPECT_EQ(setup.scene.get(), scene);
  EXPECT_EQ(known.scene, nullptr);
  EXPECT_EQ(setup.integratorName, "directlighting");
  EXPECT_EQ(setup.sceneHash, known.sceneHash);
  EXPECT_EQ(setup.worldHash, known.worldHash);
  EXPECT_EQ(setup.inputFiles, known.inputFiles);
  std::vector<std::string> plugins = known.plugins;
  std::ranges::replace(plugins, "integrators/path", "integrators/directlighting");
  EXPECT_EQ(setup.plugins, plugins);
}

TEST(SceneBuilder, TakesASceneFromOneSetupToTheNext) {
  std::vector<BuiltScene> built;  // scenes may refer to the log of the first
  built.push_back(BuildText(kWorldsBegin + "LightSource \"point\"\nWorldEnd\n"));
  ASSERT_EQ(built[0].error, "");
  for (const char* integrator : {"path", "directlighting"}) {
    LoadOptions again;
    again.known = built.back().setups.at(0).get();
    again.integrator = integrator;
    built.push_back(BuildText("", again));
    ASSERT_EQ(built.back().error, "");
  }
  EXPECT_EQ(built.back().setups.at(0)->plugins, built[0].setups.at(0)->plugins);
}

// Returns properties of the objects outside the world.
std::string ObjectsOf(const RenderSetup& setup) {
  std::ostringstream text;
  for (const Real time : {Real(0), Real(1)}) {
    const auto ray =
        setup.camera->GenerateRay({{Real(3.5), Real(1.5)}, {Real(.3), Real(.6)}, time}, false);
    text << ray.o.x << ' ' << ray.o.y << ' ' << ray.o.z << ' ' << ray.d.x << ' ' << ray.d.y << ' '
         << ray.d.z << ' ' << ray.time << '\n';
  }
  const FilterSample sample = setup.filter->Sample({Real(.1), Real(.8)});
  text << sample.offset.x << ' ' << sample.offset.y << ' ' << sample.weight << '\n';
  text << setup.film.filename << ' ' << setup.film.xResolution << ' ' << setup.crop.x0 << ' '
       << setup.crop.x1 << ' ' << setup.sampler->SamplesPerPixel() << '\n';
  text << setup.samplerName << ' ' << setup.filterName << ' ' << setup.cameraName << ' '
       << setup.integratorName << ' ' << setup.sceneHash << ' ' << setup.worldHash << '\n';
  return text.str();
}

TEST(SceneBuilder, MakesTheSameObjectsForAKnownScene) {
  const std::string text =
      "TransformTimes .5 2\nTranslate 1 2 3\nActiveTransform EndTime\nRotate 20 0 1 0\n"
      "ActiveTransform All\nCoordinateSystem \"mine\"\nIdentity\nScale 1 2 1\n"
      "CoordSysTransform \"mine\"\n"
      "Camera \"perspective\" \"float fov\" 33 \"float shutteropen\" .5 \"float shutterclose\" 2\n"
      "Film \"image\" \"integer xresolution\" 7 \"integer yresolution\" 5\n"
      "Sampler \"random\" \"integer xsamples\" 3 \"integer ysamples\" 2\n"
      "PixelFilter \"gaussian\" \"float xwidth\" 3\nSurfaceIntegrator \"path\"\n" +
      kWorldsBegin +
      "Translate 9 9 9\nActiveTransform StartTime\nCoordinateSystem \"mine\"\n"
      "LightSource \"point\"\nWorldEnd\n";
  const BuiltScene read = BuildText(text);
  ASSERT_EQ(read.error, "");
  const std::string objects = ObjectsOf(*read.setups.at(0));
  LoadOptions again;
  again.known = read.setups.at(0).get();
  const BuiltScene made = BuildText("", again);
  ASSERT_EQ(made.error, "");
  EXPECT_EQ(ObjectsOf(*made.setups.at(0)), objects);
  // Settings of the command line replace those of the file.
  again.known = made.setups.at(0).get();
  again.parameters.push_back({"Camera", "fov", "60"});
  const BuiltScene other = BuildText("", again);
  ASSERT_EQ(other.error, "");
  EXPECT_NE(ObjectsOf(*other.setups.at(0)), objects);
}

TEST(SceneBuilder, KeepsTheSceneOfAKnownSetupIfTheNewOneHasErrors) {
  const BuiltScene first = BuildText(kWorldsBegin + "LightSource \"point\"\nWorldEnd\n");
  LoadOptions again;
  again.known = first.setups.at(0).get();
  again.integrator = "none";
  EXPECT_NE(BuildText("", again).error.find("none"), std::string::npos);
  EXPECT_NE(first.setups[0]->scene, nullptr);
}

// The world is made once, and setups with other settings follow.
TEST(SceneBuilder, ReportsOnTextAndWorldToALogOfTheirOwn) {
  Log ofScene(Log::Level::Normal, Log::Sink::Memory);
  LoadOptions options;
  options.sceneLog = &ofScene;
  const BuiltScene first =
      BuildText("Sampler \"random\" \"float sampled\" 1\n" + kWorldsBegin +
                    "Shape \"sphere\" \"float radus\" 1\nAttributeBegin\n"
                    "MakeNamedMaterial \"m\" \"string type\" \"matte\"\n"
                    "MakeNamedMaterial \"m\" \"string type\" \"mirror\"\nWorldEnd\n",
                options);
  ASSERT_EQ(first.error, "");
  std::string scene;
  for (const std::string& message : ofScene.Messages()) scene += message;
  const auto has = [](const std::string& text, const char* part) {
    return text.find(part) != std::string::npos;
  };
  for (const char* part :
       {"language version 2", "radus", "without its end", "defined again", "has no light"}) {
    EXPECT_TRUE(has(scene, part)) << part << "\n" << scene;
    EXPECT_FALSE(has(first.Messages(), part)) << part << "\n" << first.Messages();
  }
  EXPECT_TRUE(has(first.Messages(), "sampled"));
  EXPECT_FALSE(has(scene, "sampled"));
  LoadOptions again;
  again.known = first.setups.at(0).get();
  const BuiltScene second = BuildText("", again);
  EXPECT_EQ(second.Messages(), first.Messages());
}

}  // namespace
}  // namespace exphoton
