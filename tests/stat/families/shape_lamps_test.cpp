// SPDX-License-Identifier: BSD-2-Clause
// These tests check every shape as a lamp and as a body: photons bring the light that shadow rays
// bring, their sum is the power of the lamp, and all accelerators see the same picture, also if the
// shapes move. Lights with maps are checked in the same way.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "core/scene/scene.h"
#include "tests/support/equivalence.h"
#include "tests/support/photon_shots.h"
#include "tests/support/test_scene.h"

namespace exphoton {
namespace {

const std::string kHeightField =
    "Shape \"heightfield\" \"integer nu\" 3 \"integer nv\" 3 \"float Pz\" [0 .5 0  1 .2 .2  0 .8 "
    ".3]\n";
const std::string kNurbs =
    "Shape \"nurbs\" \"integer nu\" 3 \"integer nv\" 3 \"integer uorder\" 3 \"integer vorder\" 3 "
    "\"float uknots\" [0 0 0 1 1 1] \"float vknots\" [0 0 0 1 1 1] \"point P\" [-.5 -.5 0  0 -.5 "
    ".6  .5 -.5 0  -.5 0 .4  0 0 1  .5 0 .4  -.5 .5 0  0 .5 .6  .5 .5 0]\n";
const std::string kHyperboloid =
    "Shape \"hyperboloid\" \"point p1\" [.5 0 -.4] \"point p2\" [-.2 .4 .4]\n";

struct Lamp {
  const char* name;
  std::string shape;  // or a light
  bool isLight = false;
};

class LampFamily : public testing::TestWithParam<Lamp> {
 protected:
  static std::string World() {
    const std::string lamp = GetParam().isLight ? GetParam().shape
                                                : "Material \"matte\" \"color Kd\" [.5 .5 "
                                                  ".5]\nAreaLightSource \"area\" \"color L\" [2 2 "
                                                  "2]\n" +
                                                      GetParam().shape;
    return "WorldBegin\nAttributeBegin\nTranslate .1 .2 -1.3 Scale .6 .6 .6\nRotate 50 1 2 3\n" +
           lamp +
           "AttributeEnd\nMaterial \"matte\" \"color Kd\" [.5 .5 .5]\nTranslate 0 0 1\n"
           "ReverseOrientation\nShape \"sphere\" \"float radius\" 3\nWorldEnd\n";
  }
};

SeedEstimate MeanOf(const std::string& scene) {
  return EstimateOverSeeds([&](std::uint64_t seed) {
    TestRenderOptions options;
    options.seed = seed;
    return MeanRadiance(RenderSceneText(scene, options).image);
  });
}

// The camera sees the room and not the lamp, whose edges the photon map would blur.
TEST_P(LampFamily, LightsByPhotonsAsByShadowRays) {
  const SeedEstimate photons = MeanOf(
      TestHeader("\"photonmap\" \"bool directwithphotons\" \"true\" \"integer directphotons\" "
                 "150000 \"integer nused\" 150 \"integer indirectphotons\" 0 \"bool "
                 "finalgather\" \"false\"",
                 16, 16, 4) +
      World());
  const SeedEstimate rays =
      MeanOf(TestHeader("\"directlighting\" \"integer maxdepth\" 0", 16, 16, 64) + World());
  EXPECT_TRUE(IsWithin(.04, photons, rays.mean));
  EXPECT_LE(rays.halfWidth, .01 * rays.mean);
}

// Nothing escapes from the room, so the photons of the direct map together carry the whole power.
TEST_P(LampFamily, ShootsItsPower) {
  const LoadedScene loaded = LoadSceneText(World());
  PhotonTargets targets;
  targets[PhotonKind::Direct] = 100000;
  PhotonPassResult result = ShootPhotons(*loaded.setup->scene, 1, targets);
  double sum = 0;
  PhotonBuffer& direct = result[PhotonKind::Direct];
  for (std::size_t i = 0; i < direct.photons.Size(); ++i)
    sum += double(direct.photons.Records()[i].power.Power().g);
  double power = 0;
  for (const auto& light : loaded.setup->scene->Lights()) power += double(light->Power().g);
  EXPECT_NEAR(sum / double(direct.paths) / power, 1, GetParam().isLight ? .01 : 1e-3);
}

std::string Light(const std::string& name) {
  return "LightSource \"" + name + "\" \"string mapname\" \"" + EXPHOTON_SOURCE_DIR +
         "/scenes/parts/tile_height.png\"\n";
}

INSTANTIATE_TEST_SUITE_P(
    All, LampFamily,
    testing::Values(Lamp{"cone", "Shape \"cone\" \"float radius\" .6 \"float phimax\" 300\n"},
                    Lamp{"paraboloid", "Shape \"paraboloid\" \"float radius\" .5\n"},
                    Lamp{"hyperboloid", kHyperboloid}, Lamp{"heightfield", kHeightField},
                    Lamp{"nurbs", kNurbs}, Lamp{"goniometric", Light("goniometric"), true},
                    Lamp{"projection", Light("projection"), true}),
    [](const auto& info) { return std::string(info.param.name); });

std::string Bodies(bool move) {
  const std::string motion =
      move ? "ActiveTransform EndTime Translate .3 .1 0 Rotate 40 1 1 0 ActiveTransform All\n" : "";
  const auto place = [&](const std::string& at, const std::string& shape) {
    return "AttributeBegin\nTranslate " + at + "\n" + motion + shape + "AttributeEnd\n";
  };
  return "WorldBegin\nLightSource \"infinite\"\nTexture \"grain\" \"color\" \"marble\"\n"
         "Material \"matte\" \"texture Kd\" \"grain\"\n" +
         place("-1 -.8 3", "Shape \"cone\"\n") + place("1 -.8 3", "Shape \"paraboloid\"\n") +
         place("0 .8 3", kHyperboloid) + place("-1 .6 2.5", kHeightField) +
         place("1 .8 2.5", kNurbs) +
         (move ? "ObjectBegin \"o\"\n" + kNurbs + kHyperboloid +
                     "ObjectEnd\nTranslate 0 -.2 2 Rotate 30 1 0 0\nObjectInstance \"o\"\n"
               : "") +
         "WorldEnd\n";
}

Image Picture(const std::string& accelerator, const std::string& world) {
  return RenderSceneText("Accelerator \"" + accelerator + "\"\n" +
                         TestHeader("\"directlighting\"", 24, 24, 8) + world)
      .image;
}

TEST(ShapeFamily, LooksTheSameWithEveryAcceleratorWhileItMoves) {
  const Image truth = Picture("bruteforce", Bodies(true));
  EXPECT_EQ(Picture("bvh", Bodies(true)).pixels, truth.pixels);
  EXPECT_EQ(Picture("kdtree", Bodies(true)).pixels, truth.pixels);
#if defined(EXPHOTON_EMBREE)
  // Embree's own test may miss a triangle that a ray only touches.
  const Image other = Picture("embree", Bodies(true));
  int different = 0;
  for (std::size_t i = 0; i < truth.pixels.size(); i += 4)
    different += !std::equal(&truth.pixels[i], &truth.pixels[i] + 4, &other.pixels[i]);
  EXPECT_LE(different, 24 * 24 * 3 / 100);
#endif
}

// Powers of two scale the scene without rounding.
TEST(ShapeFamily, LooksTheSameAtEveryScaleOfAPowerOfTwo) {
  const auto picture = [](int exponent) {
    char scale[200];
    const double s = std::ldexp(1., exponent);
    std::snprintf(
        scale, sizeof scale,
        "Camera \"perspective\" \"float fov\" 90 \"float hither\" %.17g\nWorldBegin\nScale "
        "%.17g %.17g %.17g\n",
        s / 1024, s, s, s);
    return Picture("bvh", scale + Bodies(false).substr(std::string("WorldBegin\n").size()));
  };
  const Image one = picture(0);
  EXPECT_EQ(picture(20).pixels, one.pixels);
  EXPECT_EQ(picture(-20).pixels, one.pixels);
}

}  // namespace
}  // namespace exphoton
