// SPDX-License-Identifier: BSD-2-Clause
// These tests light rooms whose walls are single polygons from outside, much more brightly than
// from inside. No light may come through the walls, although density estimates find photons on both
// sides.
#include <gtest/gtest.h>

#include <string>

#include "tests/support/equivalence.h"
#include "tests/support/test_scene.h"

namespace exphoton {
namespace {

std::string Quad(const std::string& points) {
  return "Shape \"trianglemesh\" \"integer indices\" [0 1 2 0 2 3] \"point P\" [" + points + "]\n";
}

std::string Lamp(const std::string& place, const std::string& radiance) {
  return "AttributeBegin\nAreaLightSource \"diffuse\" \"color L\" [" + radiance + " " + radiance +
         " " + radiance + "]\nMaterial \"matte\" \"color Kd\" [0 0 0]\nTranslate " + place +
         "\nShape \"sphere\" \"float radius\" [.2]\nAttributeEnd\n";
}

// A closed box from -2 to 2, 2 high, with a lamp on its left side. `more` is added to the world.
// The camera is in the left half and looks to the left.
std::string ThinRoom(const std::string& more, const std::string& parameters = "") {
  return "LookAt -.3 1 1.7 -1.2 .7 -1 0 1 0\nCamera \"perspective\" \"float fov\" [70]\n"
         "Film \"image\" \"integer xresolution\" [16] \"integer yresolution\" [12]\n"
         "PixelFilter \"box\"\nSampler \"lowdiscrepancy\" \"integer pixelsamples\" [16]\n"
         "SurfaceIntegrator \"exphotonmap\" " +
         parameters + "\nWorldBegin\nMaterial \"matte\" \"color Kd\" [.5 .5 .5]\n" +
         Quad("-2 0 -2  2 0 -2  2 0 2  -2 0 2") + Quad("-2 2 -2  2 2 -2  2 2 2  -2 2 2") +
         Quad("-2 0 -2  -2 2 -2  -2 2 2  -2 0 2") + Quad("2 0 -2  2 2 -2  2 2 2  2 0 2") +
         Quad("-2 0 -2  -2 2 -2  2 2 -2  2 0 -2") + Quad("-2 0 2  -2 2 2  2 2 2  2 0 2") +
         Lamp("-1 1.5 0", "10") + more + "WorldEnd\n";
}

SeedEstimate LightOf(const std::string& scene) {
  return EstimateOverSeeds([&](std::uint64_t seed) {
    TestRenderOptions options;
    options.seed = seed;
    return MeanRadiance(RenderSceneText(scene, options).image);
  });
}

// The sun lights the roof, and a plane below the box. The light inside was 1.16 times the light
// without a sun when photons on the roof counted on the walls.
TEST(ThinWalls, KeepTheSunOut) {
  const std::string sun =
      "LightSource \"distant\" \"color L\" [100 100 100]\n"
      "\"point from\" [-1 2 1.3] \"point to\" [0 0 0]\n";
  const std::string ground = Quad("-8 -.5 -8  8 -.5 -8  8 -.5 8  -8 -.5 8");
  const SeedEstimate dark = LightOf(ThinRoom(ground)), sunny = LightOf(ThinRoom(ground + sun));
  EXPECT_TRUE(IsWithin(.03, sunny, dark.mean));
}

const std::string kPartition = Quad("0 0 -2  0 2 -2  0 2 2  0 0 2");

// The bright half has 100 times the light. The ratio of
// the two means was 1.15 when photons of its floor and its
// side of the partition counted in the dark half.
TEST(ThinWalls, KeepABrightNeighbourOut) {
  const SeedEstimate alone = LightOf(ThinRoom(kPartition + Lamp("1 1.5 .5", "10")));
  const SeedEstimate beside = LightOf(ThinRoom(kPartition + Lamp("1 1.5 .5", "1000")));
  EXPECT_TRUE(IsWithin(.04, beside, alone.mean));
}

// Hidden photons count up to the number of the seen ones, so no light is lost.
TEST(ThinWalls, LoseNoLightIfBothSidesAreEquallyBright) {
  const std::string both = kPartition + Lamp("1 1.5 .5", "10");
  const SeedEstimate without = LightOf(ThinRoom(both, "\"bool hidephotons\" \"false\""));
  EXPECT_TRUE(IsWithin(.01, LightOf(ThinRoom(both)), without.mean));
}

}  // namespace
}  // namespace exphoton
