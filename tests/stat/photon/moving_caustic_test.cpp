// SPDX-License-Identifier: BSD-2-Clause
// The caustic of a glass ball that moves is seen when it is there. It lies behind the ball, which
// hides it from the camera and then moves on. A map of the whole exposure showed it afterwards, so
// this part of the picture was 24 % too bright.
#include <gtest/gtest.h>

#include "core/render/certificate/corrections.h"
#include "tests/support/equivalence.h"
#include "tests/support/test_scene.h"

namespace exphoton {
namespace {

// Place is a crop of the picture, in fractions of it, and the balls on the floor.
struct Place {
  std::string crop, world;
};

const std::string kBallOfGlass =
    "Material \"glass\" Translate 0 .8 0 Shape \"sphere\" \"float radius\" .8\n";
const Place kWayOfGlass{
    ".25 .5 .34 .66",
    "ActiveTransform EndTime Translate 1.5 0 0 ActiveTransform All\n" + kBallOfGlass};
// The caustic of a ball at rest is most of the light of these 8 pixels. A matte ball moves.
const Place kCausticAtRest{".5 .625 .584 .667",
                           "AttributeBegin ActiveTransform EndTime Translate .5 0 0 "
                           "ActiveTransform All Translate 2.4 .3 2.2 "
                           "Shape \"sphere\" \"float radius\" .3 AttributeEnd\n" +
                               kBallOfGlass};

std::string SceneOf(const Place& place, const std::string& integrator, int samples) {
  return "LookAt 0 2.5 -5.5  0 .7 0  0 1 0\nCamera \"perspective\" \"float fov\" 45\n"
         "Film \"image\" \"integer xresolution\" 32 \"integer yresolution\" 24 "
         "\"float cropwindow\" [" +
         place.crop +
         "]\nPixelFilter \"box\"\n"
         "Sampler \"lowdiscrepancy\" \"integer pixelsamples\" " +
         std::to_string(samples) + "\nSurfaceIntegrator " + integrator +
         "\nWorldBegin\nAttributeBegin\nAreaLightSource \"area\" \"color L\" [12 12 12]\n"
         "Translate 1.2 3.9 -.5 Rotate 90 1 0 0 Shape \"disk\" \"float radius\" .7\nAttributeEnd\n"
         "Material \"matte\" \"color Kd\" [.5 .5 .5]\n"
         "Shape \"trianglemesh\" \"integer indices\" [0 1 2 0 2 3]\n"
         "  \"point P\" [-3 0 -3  3 0 -3  3 0 3  -3 0 3]\n" +
         place.world + "WorldEnd\n";
}

SeedEstimate LightOf(const Place& place, const std::string& integrator, int samples) {
  const std::string scene = SceneOf(place, integrator, samples);
  return EstimateOverSeeds([&](std::uint64_t seed) {
    TestRenderOptions options;
    options.seed = seed;
    options.threads = 2;
    return MeanRadiance(RenderSceneText(scene, options).image);
  });
}

void ExpectTheLightOfPaths(const Place& place, int samplesOfPaths) {
  const std::string photons =
      "\"exphotonmap\" \"integer indirectphotons\" 5000 \"integer causticphotons\" 40000 "
      "\"integer maxdepth\" 20";
  const SeedEstimate truth = LightOf(place, "\"path\" \"integer maxdepth\" 30", samplesOfPaths);
  EXPECT_LT(truth.halfWidth, .02 * truth.mean);
  EXPECT_TRUE(IsWithin(.05, LightOf(place, photons, samplesOfPaths / 16), truth.mean));
}

TEST(MovingCaustic, OfAGlassBallIsSeenWhenItIsThere) { ExpectTheLightOfPaths(kWayOfGlass, 1024); }

// Rays are tried at the places of photons, where the caustic is only at the time of the photon.
TEST(MovingCaustic, IsCorrectedByRays) {
  const std::string integrator =
      "\"exphotonmap\" \"bool finalgather\" \"false\" \"integer indirectphotons\" 500 "
      "\"integer causticphotons\" 20000";
  LoadedScene scene = LoadSceneText(SceneOf(kWayOfGlass, integrator, 16));
  Corrections corrections(scene.setup->crop, 1);
  TestRenderOptions options;
  options.corrections = &corrections;
  const RayCounters rays = RenderLoaded(scene, options).rays;
  EXPECT_GT(rays.counts[std::size_t(RayKind::Gather)], 0u);
}

TEST(MovingCaustic, LeavesACausticAtRestAsItIs) { ExpectTheLightOfPaths(kCausticAtRest, 8192); }

}  // namespace
}  // namespace exphoton
