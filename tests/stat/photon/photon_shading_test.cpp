// SPDX-License-Identifier: BSD-2-Clause
// This test shoots photons that leave a plate with tilted shading normals. Cameras see a constant
// radiance on the plate, and the photons must carry the irradiance of this radiance to a floor.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "tests/support/equivalence.h"
#include "tests/support/test_scene.h"

namespace exphoton {
namespace {

constexpr double kPi64 = 3.14159265358979;
constexpr double kAlbedo = .8;
constexpr double kView = .6;  // the picture covers [-kView, kView]^2 of the floor

// The plate x = 1 meets the floor z = 0, and both measure 2 x 2. Light of irradiance 1 travels
// along x: it hits the plate at right angles and misses the floor. The shading normals are tilted
// downwards by `degrees`.
std::string Corner(double degrees) {
  const double angle = degrees * kPi64 / 180;
  char n[64];
  std::snprintf(n, sizeof n, " %.6f 0 %.6f", -std::cos(angle), -std::sin(angle));
  const std::string normal = n;
  return "LookAt 0 0 1  0 0 0  0 1 0\nCamera \"orthographic\" \"float screenwindow\" [-.6 .6 -.6 "
         ".6]\nFilm \"image\" \"integer xresolution\" 12 \"integer yresolution\" 12\nPixelFilter "
         "\"box\"\nSampler \"lowdiscrepancy\" \"integer pixelsamples\" 2\nSurfaceIntegrator "
         "\"exphotonmap\" \"integer indirectphotons\" 6000 \"integer nused\" 6000 \"float "
         "maxdist\" "
         ".15 \"string show\" \"indirectphotons\" \"bool finalgather\" \"false\" \"string "
         "photonaim\" "
         "\"off\"\nWorldBegin\nLightSource \"distant\" \"color L\" [1 1 1] \"point from\" [-1 0 0] "
         "\"point to\" [0 0 0]\nMaterial \"matte\" \"color Kd\" [.01 .01 .01]\nShape "
         "\"trianglemesh\" \"integer indices\" [0 1 2 0 2 3] \"point P\" [-1 -1 0 1 -1 0 1 1 0 "
         "-1 1 0]\nMaterial \"matte\" \"color Kd\" [.8 .8 .8]\nShape \"trianglemesh\" \"integer "
         "indices\" [0 1 2 0 2 3] \"point P\" [1 -1 0 1 1 0 1 1 2 1 -1 2] \"normal N\" [" +
         normal + normal + normal + normal + "]\nWorldEnd\n";
}

// Returns the mean irradiance on the visible part of the floor, per radiance of the plate.
double FormFactor() {
  constexpr int kPlate = 60, kFloor = 24;
  double sum = 0;
  for (int i = 0; i < kFloor * kFloor; ++i) {
    const double x = kView * ((i % kFloor + .5) / kFloor * 2 - 1);
    const double y = kView * ((i / kFloor + .5) / kFloor * 2 - 1);
    for (int k = 0; k < kPlate * kPlate; ++k) {
      const double dx = 1 - x, dy = (k % kPlate + .5) / kPlate * 2 - 1 - y;
      const double dz = (k / kPlate + .5) / kPlate * 2;
      const double distance2 = dx * dx + dy * dy + dz * dz;
      sum += dx * dz / (distance2 * distance2) * 4 / (kPlate * kPlate);
    }
  }
  return sum / (kFloor * kFloor);
}

// Normals are not tilted upwards. The BSDF would then sample the floor less often than
// photons go there.
TEST(PhotonShading, PhotonsLeaveTiltedNormalsAsTheRadianceThatCamerasSee) {
  for (const double degrees : {0.0, 50.0}) {
    const std::string scene = Corner(degrees);
    const auto measure = [&](std::uint64_t seed) {
      TestRenderOptions options;
      options.seed = seed;
      return MeanRadiance(RenderSceneText(scene, options).image);
    };
    const double plate = kAlbedo / kPi64 * std::cos(degrees * kPi64 / 180);
    const double expected = .01 / kPi64 * plate * FormFactor();
    EXPECT_TRUE(IsWithin(.03, EstimateOverSeeds(measure), expected)) << degrees << " degrees";
  }
}

// A floor whose shading normals lean by 40 degrees along x, by interpolation or by bumps, under
// sunlight that comes from `degrees` off the vertical. Direct light from photons, without shadow
// rays.
std::string LeaningFloor(double degrees, bool isBumped) {
  const double angle = degrees * kPi64 / 180;
  const std::string n = isBumped ? " 0 0 1" : " .642788 0 .766044";
  // The bumps descend by 2 tan(40 degrees) over the width of the floor.
  const std::string bumps =
      isBumped ? "Texture \"slope\" \"float\" \"bilerp\" \"float v00\" 1.678199 \"float v01\" "
                 "1.678199 \"float v10\" 0 \"float v11\" 0\n"
               : "";
  const std::string bumpMap = isBumped ? " \"texture bumpmap\" \"slope\"" : "";
  char from[64];
  std::snprintf(from, sizeof from, "%.6f 0 %.6f", std::sin(angle), std::cos(angle));
  return "LookAt 0 0 1  0 0 0  0 1 0\nCamera \"orthographic\" \"float screenwindow\" [-.6 .6 -.6 "
         ".6]\nFilm \"image\" \"integer xresolution\" 8 \"integer yresolution\" 8\nPixelFilter "
         "\"box\"\nSampler \"lowdiscrepancy\" \"integer pixelsamples\" 2\nSurfaceIntegrator "
         "\"photonmap\" \"bool directwithphotons\" \"true\" \"integer directphotons\" 20000 "
         "\"integer indirectphotons\" 0 \"integer nused\" 400 \"bool finalgather\" \"false\"\n"
         "WorldBegin\nLightSource \"distant\" \"color L\" [1 1 1] \"point from\" [" +
         std::string(from) + "] \"point to\" [0 0 0]\n" + bumps +
         "Material \"matte\" \"color Kd\" [.5 .5 .5]" + bumpMap +
         "\nShape \"trianglemesh\" \"integer indices\" [0 1 2 0 2 3] \"point P\" [-1 -1 0 1 -1 0 1 "
         "1 "
         "0 -1 1 0] \"float uv\" [0 0 1 0 1 1 0 1] \"normal N\" [" +
         n + n + n + n + "]\nWorldEnd\n";
}

void ExpectLightOnLeaningNormal(bool isBumped) {
  // Light from -60 degrees is in front of the surface and behind its shading normal.
  for (const double degrees : {60.0, 0.0, -30.0, -60.0}) {
    const auto measure = [&](std::uint64_t seed) {
      TestRenderOptions options;
      options.seed = seed;
      return MeanRadiance(RenderSceneText(LeaningFloor(degrees, isBumped), options).image);
    };
    const double expected = .5 / kPi64 * std::abs(std::cos((degrees - 40) * kPi64 / 180));
    EXPECT_TRUE(IsWithin(.03, EstimateOverSeeds(measure), expected)) << degrees << " degrees";
  }
}

TEST(PhotonShading, AnEstimateOnALeaningNormalIsTheLightOnThatNormal) {
  ExpectLightOnLeaningNormal(false);
}
TEST(PhotonShading, AnEstimateOnABumpIsTheLightOnItsNormal) { ExpectLightOnLeaningNormal(true); }

// A small ceiling over the floor of LeaningFloor, seen from below. All its light comes from the
// floor.
std::string CeilingOverFloor(double degrees, bool isBumped) {
  std::string scene = LeaningFloor(degrees, isBumped);
  const auto replace = [&](const std::string& from, const std::string& to) {
    const std::size_t at = scene.find(from);
    ASSERT_NE(at, std::string::npos) << from;
    scene.replace(at, from.size(), to);
  };
  replace("LookAt 0 0 1  0 0 0", "LookAt 0 0 .1  0 0 1");
  replace("[-.6 .6 -.6 .6]", "[-.1 .1 -.1 .1]");
  replace(R"("photonmap" "bool directwithphotons" "true")",
          R"("exphotonmap" "bool sharedgather" "false" "integer finalgathersamples" 64)");
  replace("\"integer nused\" 400 \"bool finalgather\" \"false\"", "\"integer nused\" 50");
  replace("WorldEnd\n",
          "Material \"matte\"\nShape \"trianglemesh\" \"integer indices\" [0 1 2 0 2 3] "
          "\"point P\" [-.1 -.1 .5 .1 -.1 .5 .1 .1 .5 -.1 .1 .5]\nWorldEnd\n");
  return scene;
}

// A floor with bumps and one with interpolated normals reflect the same light. Photons store the
// cosine to an interpolated normal in their power, and radiance photons apply the one to a bump.
TEST(PhotonShading, GatherRaysSeeTheLightOfBumps) {
  for (const double degrees : {60.0, -30.0}) {
    const auto measure = [&](bool isBumped) {
      return EstimateOverSeeds([&](std::uint64_t seed) {
        TestRenderOptions options;
        options.seed = seed;
        return MeanRadiance(RenderSceneText(CeilingOverFloor(degrees, isBumped), options).image);
      });
    };
    EXPECT_TRUE(IsWithin(.03, measure(true), measure(false).mean)) << degrees << " degrees";
  }
}

// A pleated sheet of strips along z, whose slopes alternate. All its shading normals point upwards.
// Sunlight grazes every second strip. Density estimates are as wide as several strips.
std::string PleatedSheet(const std::string& integrator) {
  constexpr int kEdges = 17;
  std::string points, normals, indices;
  for (int i = 0; i < kEdges; ++i) {
    char text[80];
    std::snprintf(text, sizeof text, " %.4f %.4f -1 %.4f %.4f 1", i / 8. - 1, .06 * (i % 2),
                  i / 8. - 1, .06 * (i % 2));
    points += text;
    normals += " 0 1 0 0 1 0";
    std::snprintf(text, sizeof text, " %d %d %d %d %d %d", 2 * i, 2 * i + 1, 2 * i + 2, 2 * i + 1,
                  2 * i + 3, 2 * i + 2);
    if (i + 1 < kEdges) indices += text;
  }
  return "LookAt 0 3 0  0 0 0  0 0 1\nCamera \"orthographic\" \"float screenwindow\" [-.6 .6 -.6 "
         ".6]\nFilm \"image\" \"integer xresolution\" 12 \"integer yresolution\" 12\nPixelFilter "
         "\"box\"\nSampler \"lowdiscrepancy\" \"integer pixelsamples\" 16\nSurfaceIntegrator " +
         integrator +
         "\nWorldBegin\nLightSource \"distant\" \"color L\" [3 3 3] \"point from\" [2.6 1.6 0] "
         "\"point to\" [0 0 0]\nMaterial \"matte\" \"color Kd\" [.5 .5 .5]\nShape \"trianglemesh\" "
         "\"integer indices\" [" +
         indices + "] \"point P\" [" + points + "] \"normal N\" [" + normals + "]\nWorldEnd\n";
}

// A photon counts with the cosine to its own triangle. With the cosine to the triangle of the
// estimate, the grazed strips would be more than twice as bright.
TEST(PhotonShading, AnEstimateOverSmoothTrianglesHasTheLightOfEach) {
  const double expected =
      MeanRadiance(RenderSceneText(PleatedSheet("\"directlighting\""), {}).image);
  const auto measure = [&](std::uint64_t seed) {
    TestRenderOptions options;
    options.seed = seed;
    const std::string photons =
        "\"photonmap\" \"bool directwithphotons\" \"true\" \"integer directphotons\" 20000 "
        "\"integer indirectphotons\" 0 \"integer nused\" 400 \"bool finalgather\" \"false\"";
    return MeanRadiance(RenderSceneText(PleatedSheet(photons), options).image);
  };
  EXPECT_TRUE(IsWithin(.03, EstimateOverSeeds(measure), expected));
}

}  // namespace
}  // namespace exphoton
