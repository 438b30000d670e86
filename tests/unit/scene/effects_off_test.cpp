// SPDX-License-Identifier: BSD-2-Clause
// These tests check --effects X=off, one effect at a time. In a scene that needs the effect, the
// option must remove the light of the effect and nothing else. A wrong rule of feature culling
// would also show in these scenes.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/test_scene.h"

namespace exphoton {
namespace {

const std::string kFloor =
    "Material \"matte\" \"color Kd\" [.7 .6 .5]\nShape \"trianglemesh\" \"point P\" "
    "[-9 -1 -9 9 -1 -9 9 -1 9 -9 -1 9] \"integer indices\" [0 1 2 0 2 3] "
    "\"float uv\" [0 0 30 0 30 30 0 30]\n";
const std::string kLamp =
    "AttributeBegin AreaLightSource \"area\" \"color L\" [9 8 7] Translate 0 3 4 "
    "Shape \"sphere\" \"float radius\" 1.2 AttributeEnd\n";
const std::string kSky = "LightSource \"infinite\" \"color L\" [.2 .3 .4]\n";
const std::string kWall =
    "AttributeBegin Material \"matte\" Translate 0 0 6 Shape \"disk\" \"float radius\" 4 "
    "AttributeEnd\n";
const std::string kGlass =
    "AttributeBegin Material \"glass\" Translate -.5 -.3 3 Shape \"sphere\" \"float radius\" .7 "
    "AttributeEnd\n";
const std::string kMirror =
    "AttributeBegin Material \"mirror\" Translate .5 .3 5 Shape \"disk\" \"float radius\" 2 "
    "AttributeEnd\n";

const std::string kPath = "\"path\"";
const std::string kPhotons =
    "\"exphotonmap\" \"integer causticphotons\" 1000 \"integer indirectphotons\" 1000 "
    "\"integer finalgathersamples\" 8 \"integer maxphotonpaths\" 100000";

TestRender Render(const std::string& integrator, const std::string& world,
                  const std::string& effects, AovSet aovs = {}, const std::string& camera = "") {
  TestRenderOptions options;
  options.load.effects = effects;
  options.aovs = aovs;
  return RenderSceneText(
      TestHeader(integrator, 16, 12, 4) + camera + "WorldBegin\n" + world + "WorldEnd\n", options);
}

TEST(EffectsOff, CausticsTakeTheLightOfSpecularSurfacesOffReceivers) {
  for (const std::string& integrator : {kPath, kPhotons}) {
    const std::string world = kLamp + kFloor + kWall + kGlass;
    const Image on = Render(integrator, world, "auto", kLightAovs).image;
    const TestRender off = Render(integrator, world, "caustics=off", kLightAovs);
    EXPECT_GT(MeanChannel(on, "caustic.G"), 0);
    EXPECT_EQ(MeanChannel(off.image, "caustic.G"), 0);
    EXPECT_LT(MeanRadiance(off.image), MeanRadiance(on)) << integrator;
    EXPECT_EQ(MeanChannel(off.image, "direct.G"), MeanChannel(on, "direct.G"));
    EXPECT_EQ(MeanChannel(off.image, "emission.G"), MeanChannel(on, "emission.G"));
    EXPECT_TRUE(off.Says("leaves out light that the scene needs"));
  }
}

TEST(EffectsOff, IndirectLeavesEmissionDirectLightAndCaustics) {
  for (const std::string& integrator : {kPath, kPhotons}) {
    const std::string world = kLamp + kFloor + kWall + kGlass;
    const Image on = Render(integrator, world, "auto", kLightAovs).image;
    const TestRender off = Render(integrator, world, "indirect=off", kLightAovs);
    EXPECT_GT(MeanChannel(on, "indirect.G"), .001);
    EXPECT_EQ(MeanChannel(off.image, "indirect.G"), 0);
    for (const char* aov : {"direct.G", "emission.G"})
      EXPECT_EQ(MeanChannel(off.image, aov), MeanChannel(on, aov)) << aov;
    EXPECT_GT(MeanChannel(off.image, "caustic.G"), 0) << integrator;
    EXPECT_GT(MeanChannel(off.image, "specular.G"), 0);
  }
}

TEST(EffectsOff, IndirectLeavesTheDirectMapWhereThatIsTheDirectLight) {
  const std::string integrator =
      "\"photonmap\" \"bool directwithphotons\" \"true\" \"integer directphotons\" 2000";
  const TestRender off = Render(integrator, kLamp + kFloor + kWall, "indirect=off");
  EXPECT_GE(off.Counter("photons/direct stored"), 2000);
  EXPECT_GT(MeanRadiance(off.image), .01);
}

TEST(EffectsOff, TransmissionLeavesTheTransmittedSideOutOfRadiancePhotons) {
  const std::string screen =
      "AttributeBegin Material \"translucent\" Translate 0 0 5 Shape \"disk\" \"float radius\" 4 "
      "AttributeEnd LightSource \"point\" \"point from\" [0 0 7]\n";
  const double on = MeanRadiance(Render(kPhotons, screen + kFloor, "auto").image);
  const double off = MeanRadiance(Render(kPhotons, screen + kFloor, "transmission=off").image);
  EXPECT_LT(off, on);
  EXPECT_GT(off, 0);
}

TEST(EffectsOff, SpecularMakesMirrorsBlackForEveryKindOfRay) {
  const std::string world = kLamp + kFloor + kMirror + kGlass;
  for (const std::string& integrator :
       {kPath, kPhotons, std::string("\"whitted\""), std::string("\"directlighting\"")}) {
    const Image on = Render(integrator, world, "auto", kLightAovs).image;
    const TestRender off = Render(integrator, world, "specular=off", kLightAovs);
    EXPECT_GT(MeanChannel(on, "specular.G"), .001) << integrator;
    EXPECT_EQ(MeanChannel(off.image, "specular.G"), 0) << integrator;
    EXPECT_EQ(off.rays.counts[std::size_t(RayKind::Specular)], 0u) << integrator;
  }
  // Neither photons nor gather rays leave a mirror, as if the mirror were black.
  std::string black = world;
  for (const auto& [material, replacement] :
       {std::pair<std::string, std::string>{"\"mirror\"", "\"mirror\" \"color Kr\" [0 0 0]"},
        {"\"glass\"", "\"glass\" \"color Kr\" [0 0 0] \"color Kt\" [0 0 0]"}})
    black.replace(black.find(material), material.size(), replacement);
  for (const std::string& integrator : {kPath, kPhotons})
    EXPECT_EQ(Render(integrator, world, "specular=off").image.pixels,
              Render(integrator, black, "auto").image.pixels)
        << integrator;
}

TEST(EffectsOff, EnvironmentTakesTheSkyAndItsLightAway) {
  for (const std::string& integrator :
       {kPath, kPhotons, std::string("\"whitted\""), std::string("\"directlighting\"")}) {
    const std::string world = kLamp + kFloor + kWall;
    EXPECT_EQ(Render(integrator, kSky + world, "environment=off").image.pixels,
              Render(integrator, world, "auto").image.pixels)
        << integrator;
    EXPECT_NE(Render(integrator, kSky + world, "auto").image.pixels,
              Render(integrator, world, "auto").image.pixels);
  }
}

TEST(EffectsOff, FilteringSeesTexturesAsTheyAre) {
  const std::string checks =
      "LightSource \"distant\" \"point from\" [0 1 0] \"point to\" [0 0 0]\nTexture \"t\" "
      "\"color\" \"checkerboard\"\nMaterial \"matte\" \"texture Kd\" \"t\"\n" +
      kFloor.substr(kFloor.find("Shape"));
  EXPECT_NE(Render(kPath, checks, "auto").image.pixels,
            Render(kPath, checks, "filtering=off").image.pixels);
}

TEST(EffectsOff, LensMakesAPinhole) {
  const std::string world = kLamp + kFloor + kWall;
  const std::string camera = "Camera \"perspective\" \"float fov\" 90 \"float focaldistance\" 2 ";
  const std::string wide = camera + "\"float lensradius\" .3\n",
                    narrow = camera + "\"float lensradius\" 1e-30\n";
  EXPECT_EQ(Render(kPath, world, "lens=off", {}, wide).image.pixels,
            Render(kPath, world, "lens=off", {}, narrow).image.pixels);
  EXPECT_NE(Render(kPath, world, "auto", {}, wide).image.pixels,
            Render(kPath, world, "lens=off", {}, wide).image.pixels);
}

// Nothing in this scene moves, and there are no media, so these settings change nothing.
TEST(EffectsOff, MediaAndMotionHaveNothingToLeaveOut) {
  const std::string world = kLamp + kFloor + kWall;
  const std::vector<float> expected = Render(kPath, world, "auto").image.pixels;
  for (const char* effects : {"media=off", "media=on", "motion=off", "motion=on"})
    EXPECT_EQ(Render(kPath, world, effects).image.pixels, expected) << effects;
}

}  // namespace
}  // namespace exphoton
