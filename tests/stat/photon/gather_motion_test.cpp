// SPDX-License-Identifier: BSD-2-Clause
// What gather rays read off a surface that moves: at the end of its motion a striped ceiling lights
// a floor as one that stays there. Radiance photons lie where the ceiling began.
#include <gtest/gtest.h>

#include "tests/support/equivalence.h"
#include "tests/support/test_scene.h"

namespace exphoton {
namespace {

// A spot of the floor at the origin, and over it at z = 1 a bright strip, and a dark one 4 further
// on. Light comes from below, and reaches the floor's upper side only by the ceiling.
std::string FloorBelow(const std::string& place) {
  const auto strip = [](const std::string& albedo, double x) {
    return "Material \"matte\" \"color Kd\" [" + albedo + " " + albedo + " " + albedo +
           "]\nShape \"trianglemesh\" \"integer indices\" [0 1 2 0 2 3] \"point P\" [" +
           std::to_string(x - 2) + " -4 1 " + std::to_string(x - 2) + " 4 1 " +
           std::to_string(x + 2) + " 4 1 " + std::to_string(x + 2) + " -4 1]\n";
  };
  return "LookAt 0 0 .5  0 0 0  0 1 0\nCamera \"perspective\" \"float fov\" 1 \"float "
         "shutteropen\" 1 \"float shutterclose\" 1\nFilm \"image\" \"integer xresolution\" 4 "
         "\"integer yresolution\" 4\nPixelFilter \"box\"\nSampler \"lowdiscrepancy\" \"integer "
         "pixelsamples\" 16\nSurfaceIntegrator \"exphotonmap\" \"integer directphotons\" 40000 "
         "\"integer indirectphotons\" 1000 \"integer maxphotonpaths\" 100000 \"string photonaim\" "
         "\"off\"\nWorldBegin\nLightSource \"distant\" \"color L\" [3 3 3] \"point from\" [0 0 -1] "
         "\"point to\" [0 0 0]\nMaterial \"matte\" \"color Kd\" [.5 .5 .5]\n"
         "Shape \"disk\" \"float radius\" .03\nAttributeBegin\n" +
         place + strip(".8", 0) + strip(".1", 4) + "AttributeEnd\nWorldEnd\n";
}

TEST(GatherMotion, OfAStripedCeilingEndsAsIfItHadStoodThere) {
  const auto mean = [](const std::string& place) {
    const std::string scene = FloorBelow(place);
    return EstimateOverSeeds([&](std::uint64_t seed) {
      TestRenderOptions options;
      options.seed = seed;
      return MeanRadiance(RenderSceneText(scene, options).image);
    });
  };
  const double standing = mean("").mean;
  EXPECT_GT(standing, .1);
  const std::string moving =
      "Translate -4 0 0 ActiveTransform EndTime Translate 4 0 0 ActiveTransform All\n";
  EXPECT_TRUE(IsWithin(.02, mean(moving), standing));
}

}  // namespace
}  // namespace exphoton
