// SPDX-License-Identifier: BSD-2-Clause
// These tests check the table of photons by light, and the notices about lights whose photons are
// never stored.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/test_scene.h"

namespace exphoton {
namespace {

const std::string kPhotons =
    "\"exphotonmap\" \"integer causticphotons\" 0 \"integer indirectphotons\" 3000 "
    "\"integer finalgathersamples\" 4";
const std::string kFloor =
    "Material \"matte\"\nAttributeBegin Translate 0 0 6 Shape \"disk\" \"float radius\" 4 "
    "AttributeEnd\nAttributeBegin Translate 0 -2 0 Rotate -90 1 0 0 Shape \"disk\" "
    "\"float radius\" 9 AttributeEnd\n";
const std::string kLamp = "LightSource \"point\" \"color I\" [9 9 9] \"point from\" [0 2 3]\n";
const std::string kBlackLamp = "LightSource \"point\" \"color I\" [0 0 0]\n";
// This spot light is behind the camera and points away from all surfaces.
const std::string kAway =
    "LightSource \"spot\" \"color I\" [90 90 90] \"point from\" [0 2 -20] \"point to\" [0 2 -30]\n";

TestRender Render(const std::string& world, int threads = 1,
                  const std::string& integrator = kPhotons) {
  TestRenderOptions options;
  options.threads = threads;
  return RenderSceneText(TestHeader(integrator, 4, 3, 1) + "WorldBegin\n" + world + "WorldEnd\n",
                         options);
}

TEST(LightTally, AddsUpToThePathsAndPhotonsOfTheMaps) {
  const TestRender render = Render(kLamp + kAway + kBlackLamp + kLamp + kFloor);
  double shot = 0, stored = 0;
  for (const char* light : {"1 point", "2 spot", "4 point"}) {
    const std::string name = std::string("lights/") + light;
    EXPECT_GT(render.Counter(name + " shot"), 100) << light;
    shot += render.Counter(name + " shot");
    stored += render.Counter(name + " stored");
  }
  EXPECT_EQ(shot, render.Counter("photons/shot"));
  EXPECT_EQ(stored,
            render.Counter("photons/direct stored") + render.Counter("photons/indirect stored"));
  EXPECT_EQ(render.Counter("lights/2 spot stored"), 0);
  EXPECT_TRUE(std::isnan(render.Counter("lights/3 point shot"))) << "it is black";
}

TEST(LightTally, DoesNotDependOnTheNumberOfThreads) {
  const TestRender one = Render(kLamp + kAway + kFloor), two = Render(kLamp + kAway + kFloor, 2);
  for (const char* name : {"lights/1 point shot", "lights/1 point stored", "lights/2 spot shot"})
    EXPECT_EQ(one.Counter(name), two.Counter(name)) << name;
}

TEST(LightTally, NamesTheLightWhosePhotonsHitNothing) {
  const TestRender render = Render(kLamp + kAway + kFloor);
  const auto shot = std::int64_t(render.Counter("lights/2 spot shot"));
  EXPECT_TRUE(render.Says("light 2 (spot) has shot " + std::to_string(shot) +
                          " photons and none was stored"));
  EXPECT_TRUE(render.Says("they hit nothing"));
  EXPECT_FALSE(render.Says("light 1 (point)"));
}

TEST(LightTally, TellsALightThatMeetsOnlyMirrorsFromOneThatMissesTheScene) {
  const std::string mirrors =
      "AttributeBegin Material \"mirror\" \"color Kr\" [.1 .1 .1] Translate 0 0 -20 Shape "
      "\"sphere\" AttributeEnd\n"
      "LightSource \"point\" \"color I\" [90 90 90] \"point from\" [0 0 -20]\n";
  const TestRender render = Render(kLamp + mirrors + kFloor);
  EXPECT_TRUE(render.Says("light 2 (point) has shot "));
  EXPECT_TRUE(render.Says("they hit surfaces, but left no photons"));
}

TEST(LightTally, IsSilentAboutLightsThatOnlyCauseNoCaustics) {
  const TestRender render =
      Render(kLamp + kFloor + "Material \"glass\" Translate 0 -90 0 Shape \"sphere\"\n", 1,
             "\"exphotonmap\" \"string show\" \"causticphotons\" \"integer maxphotonpaths\" 20000");
  EXPECT_GT(render.Counter("lights/1 point shot"), 1000);
  EXPECT_EQ(render.Counter("lights/1 point stored"), 0);
  EXPECT_FALSE(render.Says("has shot"));
}

TEST(LightTally, ListsTheFirstLightsOfManyAndSumsUpTheRest) {
  std::string lamps;
  for (int i = 0; i < 70; ++i) lamps += kLamp;
  const TestRender render = Render(lamps + kFloor);
  double shot = render.Counter("lights/further shot");
  EXPECT_GT(shot, 0);
  for (int i = 1; i <= 64; ++i)
    shot += render.Counter("lights/" + std::to_string(i) + " point shot");
  EXPECT_EQ(shot, render.Counter("photons/shot"));
  EXPECT_TRUE(std::isnan(render.Counter("lights/65 point shot")));
  double stored = render.Counter("lights/further stored");
  for (int i = 1; i <= 64; ++i)
    stored += render.Counter("lights/" + std::to_string(i) + " point stored");
  EXPECT_EQ(stored,
            render.Counter("photons/direct stored") + render.Counter("photons/indirect stored"));
}

// A faint light gets few paths, which may all miss by chance.
TEST(LightTally, IsSilentAboutLightsWithFewPaths) {
  const std::string faint =
      "LightSource \"spot\" \"color I\" [.1 .1 .1] \"point from\" [0 2 -20] \"point to\" [0 2 "
      "-30]\n";
  const TestRender render = Render(kLamp + faint + kFloor);
  EXPECT_GT(render.Counter("lights/2 spot shot"), 0);
  EXPECT_LT(render.Counter("lights/2 spot shot"), 1000);
  EXPECT_EQ(render.Counter("lights/2 spot stored"), 0);
  EXPECT_FALSE(render.Says("none was stored"));
}

// About one path in 10,000 meets the disk. The map must go on to the limit of paths, though it
// has few photons after the number of paths after which an empty map is given up.
TEST(LightTally, GoesOnToTheLimitOfPathsWhileAMapFills) {
  const TestRender render = Render(
      "LightSource \"point\"\nMaterial \"matte\" Translate 0 0 6 Shape \"disk\" \"float radius\" "
      ".12\n",
      1,
      "\"photonmap\" \"bool directwithphotons\" \"true\" \"bool finalgather\" \"false\" \"integer "
      "directphotons\" 1000 \"integer indirectphotons\" 0 \"integer causticphotons\" 0 "
      "\"integer maxphotonpaths\" 600000");
  EXPECT_GT(render.Counter("photons/direct stored"), 0);
  EXPECT_GE(render.Counter("photons/direct paths"), 600000);
}

// Of a point light every path carries all of its power, 4 pi I.
TEST(LightTally, SaysThePowerThatTheLightsEmit) {
  const TestRender render =
      RenderSceneText(TestHeader("\"exphotonmap\" \"integer indirectphotons\" 1000", 2, 2, 1) +
                      "WorldBegin LightSource \"point\" \"color I\" [2 2 2]\nMaterial \"matte\" "
                      "ReverseOrientation Shape \"sphere\" \"float radius\" 1\nWorldEnd\n");
  EXPECT_NEAR(render.Counter("photons/emitted power"), 8 * 3.14159265358979, 1e-3);
}

}  // namespace
}  // namespace exphoton
