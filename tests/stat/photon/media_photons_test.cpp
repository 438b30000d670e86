// SPDX-License-Identifier: BSD-2-Clause
// These tests check the light that media send to surfaces. They compare the photon integrators with
// path tracing in a closed box that fog or a glowing medium lights. They also compare the power of
// the photons with its closed form.
#include "integrators/photon/shooting/media_photons.h"

#include <gtest/gtest.h>

#include "tests/support/equivalence.h"
#include "tests/support/test_scene.h"

namespace exphoton {
namespace {

const std::string kMediaBox =
    "Material \"matte\" \"color Kd\" [.5 .5 .5]\n"
    "Shape \"trianglemesh\" \"integer indices\" [0 1 3 0 3 2 4 6 7 4 7 5 0 4 5 0 5 1 2 3 7 2 7 6 "
    "0 2 6 0 6 4 1 5 7 1 7 3] \"point P\" [-1 -1 -1 1 -1 -1 -1 1 -1 1 1 -1 -1 -1 1 1 -1 1 -1 1 1 "
    "1 1 1]\n";

const std::string kGlow =
    "Volume \"homogeneous\" \"color Le\" [20 20 20] \"point p0\" [-.1 -.1 -.1] "
    "\"point p1\" [.1 .1 .1]\n";
// Both must be chosen as often as their power says, beside a medium that glows.
const std::string kTwoLamps =
    "LightSource \"point\" \"color I\" [.01 .01 .01]\n"
    "LightSource \"point\" \"color I\" [.01 .01 .01]\n";
const std::string kPhotons =
    " \"integer indirectphotons\" 100000 \"integer finalgathersamples\" 16";

double Mean(const std::string& text, std::uint64_t seed) {
  TestRenderOptions options;
  options.seed = seed;
  return MeanRadiance(RenderSceneText(text, options).image);
}

// A small source of power P lies at the centre of a closed sphere of radius R and albedo a. It
// gives every point the irradiance P / (4 pi R^2), and all bounces together give the radiance
// a / pi P / (4 pi R^2) / (1 - a). The camera lies between the source and the part of the sphere
// that it sees.
TEST(MediaPhotons, OfAGlowingMediumLightASphereAsItsPowerSays) {
  const double albedo = .5, glow = 4 * M_PI * 20 * .008, lamp = 4 * M_PI * .02;
  // Gather rays of photonmap are not guided to glowing media, so its noise is larger.
  for (const auto& [integrator, tolerance] :
       {std::pair<std::string, double>{"\"exphotonmap\"", .01}, {"\"photonmap\"", .025}}) {
    for (const bool hasLamp : {false, true}) {
      const std::string scene = "VolumeIntegrator \"emission\"\nTranslate 0 0 -.5\n" +
                                TestHeader(integrator + kPhotons, 6, 6, 64) + "WorldBegin\n" +
                                kGlow + (hasLamp ? kTwoLamps : "") +
                                "Material \"matte\" \"color Kd\" [.5 .5 .5]\nReverseOrientation\n"
                                "Shape \"sphere\" \"float radius\" 1\nWorldEnd\n";
      const double power = glow + (hasLamp ? lamp : 0);
      const double expected = albedo / M_PI * power / (4 * M_PI) / (1 - albedo);
      const auto measure = [&](std::uint64_t seed) { return Mean(scene, seed); };
      EXPECT_TRUE(IsWithin(tolerance, EstimateOverSeeds(measure), expected))
          << integrator << hasLamp;
    }
  }
}

// Most paths begin in the medium. The others begin at the lamps by their power.
TEST(MediaPhotons, LeaveEachLampItsShareOfThePaths) {
  const TestRender render = RenderSceneText(
      TestHeader("\"photonmap\" \"integer indirectphotons\" 20000", 1, 1, 1) + "WorldBegin\n" +
      kGlow + kTwoLamps + "Shape \"sphere\" \"float radius\" 3\nWorldEnd\n");
  const double first = render.Counter("lights/1 point shot");
  EXPECT_GT(first, 100);
  EXPECT_NEAR(render.Counter("lights/2 point shot") / first, 1, .2);
}

// The fog is behind the camera, and a lamp outside the fog lights it. The camera sees only the
// fog's light on the walls. The expected value is path-traced, with fog along every ray.
TEST(MediaPhotons, OfFogThatScattersOnceLightSurfacesAsPathTracingSays) {
  const auto fog = [](double z0, double z1) {
    return "Volume \"homogeneous\" \"color sigma_a\" [.1 .1 .1] \"color sigma_s\" [3 2 1] "
           "\"float g\" -.3 \"point p0\" [-1 -1 " +
           std::to_string(z0) + "] \"point p1\" [1 1 " + std::to_string(z1) + "]\n";
  };
  const std::string whole = fog(-1, -.5), parts = fog(-1, -.75) + fog(-.75, -.5);
  const auto scene = [](const std::string& integrator, int samples, const std::string& media) {
    return "VolumeIntegrator \"single\" \"float stepsize\" .25\n" +
           TestHeader(integrator, 6, 6, samples) + "WorldBegin\n" + kMediaBox + media +
           "LightSource \"spot\" \"color I\" [5 5 5] \"point from\" [0 0 .3] "
           "\"point to\" [0 0 -1] \"float coneangle\" 25\nWorldEnd\n";
  };
  const double truth = EstimateOverSeeds([&](std::uint64_t seed) {
                         return Mean(scene("\"path\" \"integer maxdepth\" 30", 1024, whole), seed);
                       }).mean;
  // Gathers are not shared: light changes too much from pixel to pixel in a picture of 6 x 6.
  const std::string apart = "\"exphotonmap\" \"bool sharedgather\" \"false\"";
  for (const auto& [integrator, media] : {std::pair<std::string, std::string>{apart, whole},
                                          {apart, parts},
                                          {"\"photonmap\"", whole}}) {
    const auto ratio = [&](std::uint64_t seed) {
      return Mean(scene(integrator + kPhotons, 64, media), seed) / truth;
    };
    EXPECT_TRUE(IsWithin(.02, EstimateOverSeeds(ratio), 1)) << integrator << " " << media;
  }
}

// The power is 4 pi times the emission times the volume, for a medium that is rotated and scaled
// by 2, 1 and .5.
TEST(MediaPhotons, CarryThePowerThatTheMediumEmits) {
  const LoadedScene scene = LoadSceneText(
      "SurfaceIntegrator \"path\"\nVolumeIntegrator \"emission\"\nCamera \"perspective\"\n"
      "WorldBegin\nAttributeBegin Rotate 30 1 2 3 Scale 2 1 .5\n"
      "Volume \"homogeneous\" \"color Le\" [.3 .3 .3] \"point p0\" [0 0 0] \"point p1\" [1 2 3]\n"
      "AttributeEnd\nShape \"sphere\"\nWorldEnd\n");
  const MediaPhotons photons(*scene.setup->scene, scene.setup->volumeIntegrator.get());
  ASSERT_TRUE(photons.Emit());
  RandomStream random(3);
  const int count = 200000;
  double sum = 0;
  for (int i = 0; i < count; ++i) {
    const Real u = random.Uniform();
    const Point3 position(random.Uniform(), random.Uniform(), random.Uniform());
    const Point2 direction{random.Uniform(), random.Uniform()};
    sum += double(photons.SampleEmission(u, position, direction, 0).power.Y());
  }
  EXPECT_NEAR(sum / count, 4 * M_PI * .3 * 6, .01 * 4 * M_PI * .3 * 6);
}

TEST(MediaPhotons, AreNoneWhereMediaOnlyAbsorb) {
  const LoadedScene scene = LoadSceneText(
      "VolumeIntegrator \"single\"\nWorldBegin\nLightSource \"point\"\n"
      "Volume \"homogeneous\" \"color sigma_a\" [1 1 1]\nShape \"sphere\"\nWorldEnd\n");
  const MediaPhotons photons(*scene.setup->scene, scene.setup->volumeIntegrator.get());
  EXPECT_FALSE(photons.Emit());
  EXPECT_FALSE(photons.Scatter());
}

// Feature culling must count an emitting medium as a light.
TEST(MediaPhotons, OfAGlowingMediumAloneAreTheSameWithEveryEffectOn) {
  for (const char* integrator : {"\"exphotonmap\"", "\"photonmap\"", "\"path\""}) {
    const std::string scene = "VolumeIntegrator \"emission\"\n" + TestHeader(integrator, 4, 4, 4) +
                              "WorldBegin\n" + kMediaBox + kGlow + "WorldEnd\n";
    TestRenderOptions all;
    all.load.effects = "all";
    EXPECT_EQ(RenderSceneText(scene).image.pixels, RenderSceneText(scene, all).image.pixels)
        << integrator;
  }
}

}  // namespace
}  // namespace exphoton
