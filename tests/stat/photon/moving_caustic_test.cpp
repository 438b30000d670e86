// SPDX-License-Identifier: BSD-2-Clause
// The caustic of a glass ball that moves is seen when it is there. It lies behind the ball, which
// hides it from the camera and then moves on. A map of the whole exposure showed it afterwards, so
// this part of the picture was 25 % too bright.
#include <gtest/gtest.h>

#include "tests/support/equivalence.h"
#include "tests/support/test_scene.h"

namespace exphoton {
namespace {

// Returns the mean of the floor along the way of the ball. `rest` is more of the world.
SeedEstimate LightOfFloor(const std::string& integrator, int samples, const std::string& rest) {
  const std::string scene =
      "LookAt 0 2.5 -5.5  0 .7 0  0 1 0\nCamera \"perspective\" \"float fov\" 45\n"
      "Film \"image\" \"integer xresolution\" 32 \"integer yresolution\" 24 "
      "\"float cropwindow\" [.25 .5 .34 .66]\nPixelFilter \"box\"\n"
      "Sampler \"lowdiscrepancy\" \"integer pixelsamples\" " +
      std::to_string(samples) + "\nSurfaceIntegrator " + integrator +
      "\nWorldBegin\nAttributeBegin\nAreaLightSource \"area\" \"color L\" [12 12 12]\n"
      "Translate 1.2 3.9 -.5 Rotate 90 1 0 0 Shape \"disk\" \"float radius\" .7\nAttributeEnd\n"
      "Material \"matte\" \"color Kd\" [.5 .5 .5]\n"
      "Shape \"trianglemesh\" \"integer indices\" [0 1 2 0 2 3]\n"
      "  \"point P\" [-3 0 -3  3 0 -3  3 0 3  -3 0 3]\n" +
      rest +
      "ActiveTransform EndTime Translate 1.5 0 0 ActiveTransform All\n"
      "Material \"glass\" Translate 0 .8 0 Shape \"sphere\" \"float radius\" .8\nWorldEnd\n";
  return EstimateOverSeeds([&](std::uint64_t seed) {
    TestRenderOptions options;
    options.seed = seed;
    options.threads = 2;
    return MeanRadiance(RenderSceneText(scene, options).image);
  });
}

void ExpectTheLightOfPaths(const std::string& rest) {
  const std::string photons =
      "\"exphotonmap\" \"integer indirectphotons\" 5000 \"integer causticphotons\" 40000 "
      "\"integer maxdepth\" 20";
  const SeedEstimate truth = LightOfFloor("\"path\" \"integer maxdepth\" 30", 1024, rest);
  EXPECT_LT(truth.halfWidth, .02 * truth.mean);
  EXPECT_TRUE(IsWithin(.05, LightOfFloor(photons, 16, rest), truth.mean));
}

TEST(MovingCaustic, OfAGlassBallIsSeenWhenItIsThere) { ExpectTheLightOfPaths(""); }

// The caustic of a second ball, at rest, lies beside it.
TEST(MovingCaustic, LeavesACausticAtRestAsItIs) {
  ExpectTheLightOfPaths(
      "AttributeBegin Translate -1.8 .5 .5 Material \"glass\" Shape \"sphere\" \"float radius\" .5 "
      "AttributeEnd\n");
}

}  // namespace
}  // namespace exphoton
