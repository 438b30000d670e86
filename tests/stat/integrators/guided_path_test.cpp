// SPDX-License-Identifier: BSD-2-Clause
// These tests compare guidedpath with closed forms: the radiance in a furnace, and sums over a
// limited number of bounces. They also check that no photon is shot where guiding cannot help.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/equivalence.h"
#include "tests/support/test_scene.h"

namespace exphoton {
namespace {

constexpr double kTolerance = .002;

std::string Furnace(const std::string& parameters, const std::string& material, int samples) {
  return TestHeader("\"guidedpath\" \"integer indirectphotons\" 20000 " + parameters, 8, 8,
                    samples) +
         FurnaceWorld(1, material);
}

SeedEstimate GuidedMean(const std::string& scene) {
  return EstimateOverSeeds([&](std::uint64_t seed) {
    TestRenderOptions options;
    options.seed = seed;
    options.threads = 2;
    return MeanRadiance(RenderSceneText(scene, options).image);
  });
}

TEST(GuidedPathFurnace, ShowsEmissionOverOneMinusAlbedo) {
  const struct {
    const char* material;
    double albedo;
  } cases[] = {{R"("matte" "color Kd" [.5 .5 .5])", .5},
               {R"("matte" "color Kd" [.8 .8 .8])", .8},
               {R"("uber" "color Kd" [.3 .3 .3] "color Ks" [0 0 0] "color Kr" [0 0 0])", .3}};
  for (const auto& [material, albedo] : cases)
    EXPECT_TRUE(IsWithin(kTolerance,
                         GuidedMean(Furnace("\"integer maxdepth\" 200", material, 1024)),
                         1 / (1 - albedo)))
        << material;
}

TEST(GuidedPathFurnace, OfALimitedDepthShowsAPartialSum) {
  for (const int depth : {0, 1, 2, 5}) {
    double truth = 0;
    for (int i = 0; i <= depth + 1; ++i) truth += std::pow(.5, i);
    const std::string scene = Furnace("\"integer maxdepth\" " + std::to_string(depth),
                                      R"("matte" "color Kd" [.5 .5 .5])", 256);
    EXPECT_TRUE(IsWithin(kTolerance, GuidedMean(scene), truth)) << depth;
  }
}

double PhotonsShot(const std::string& scene) {
  const double shot = RenderSceneText(scene).Counter("photons/shot");
  return std::isnan(shot) ? 0 : shot;
}

TEST(GuidedPath, ShootsNoPhotonsWhereTheyCannotHelp) {
  const std::string matte = R"("matte" "color Kd" [.5 .5 .5])";
  EXPECT_GT(PhotonsShot(Furnace("", matte, 1)), 1000);
  EXPECT_EQ(PhotonsShot(Furnace("\"integer maxdepth\" 0", matte, 1)), 0);
  EXPECT_EQ(PhotonsShot(TestHeader("\"guidedpath\" \"integer indirectphotons\" 0", 8, 8, 1) +
                        FurnaceWorld(1, matte)),
            0);
}

}  // namespace
}  // namespace exphoton
