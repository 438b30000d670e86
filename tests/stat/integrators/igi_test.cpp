// SPDX-License-Identifier: BSD-2-Clause
// These tests compare instant global illumination with closed forms and with path tracing, and
// check the effect of each parameter.
#include <gtest/gtest.h>

#include "tests/stat/integrators/comparison.h"

namespace exphoton {
namespace {

TestRender Render(const std::string& scene, std::uint64_t seed = 1, int threads = 1) {
  TestRenderOptions options;
  options.seed = seed;
  options.threads = threads;
  options.aovs = kLightAovs;
  return RenderSceneText(scene, options);
}
SeedEstimate IgiMean(const std::string& scene) {
  return EstimateOverSeeds(
      [&](std::uint64_t seed) { return MeanRadiance(Render(scene, seed).image); });
}

// A closed sphere of radius 1 that emits 1 and reflects .5. Its radiance is 1 + .5 + indirect, and
// indirect light without a bound is .5.
std::string Furnace(const std::string& parameters, int samples = 16) {
  return TestHeader("\"igi\" " + parameters, 8, 8, samples) +
         FurnaceWorld(1, R"("matte" "color Kd" [.5 .5 .5])");
}
const std::string kMany = "\"integer nlights\" 64 \"integer nsets\" 16 \"float rrthreshold\" 0 ";

// Inside a sphere the geometric term is 1/4 between any two points, and mindist m <= 2 takes away
// m^2 / 8 of its integral.
TEST(Igi, InAFurnaceIsEmissionOverOneMinusAlbedo) {
  EXPECT_TRUE(IsWithin(.01, IgiMean(Furnace(kMany + "\"float mindist\" 0")), 2));
  EXPECT_TRUE(
      IsWithin(.01, IgiMean(Furnace(kMany + "\"float mindist\" 1")), 1.5 + .5 * (1 - 1. / 8)));
}

// With m >= 2, the term d^2 / (4 m^2) has the mean 1 / (2 m^2).
TEST(Igi, WithAMindistBeyondTheSceneLosesTheStatedShare) {
  EXPECT_TRUE(IsWithin(.01, IgiMean(Furnace(kMany + "\"float mindist\" 4")), 1.5 + .5 / 8));
}

// The bound takes away 60 % of the term, and gather rays give it back.
TEST(Igi, WithAGeometricLimitLosesNothing) {
  const std::string limit = "\"float glimit\" .1 \"integer maxdepth\" ";
  EXPECT_TRUE(
      IsWithin(.01, IgiMean(Furnace(kMany + limit + "12 \"integer gathersamples\" 2", 2)), 2));
  // Without gather rays, the limit is a bias.
  EXPECT_TRUE(IsWithin(.01, IgiMean(Furnace(kMany + limit + "0", 2)), 1.5 + .5 * .4));
}

TEST(Igi, RouletteOnSmallContributionsKeepsTheMean) {
  const std::string roulette =
      "\"integer nlights\" 64 \"integer nsets\" 64 \"float mindist\" 0 \"float rrthreshold\" 1000";
  EXPECT_TRUE(IsWithin(.01, IgiMean(Furnace(roulette, 64)), 2));
  const TestRender all = Render(Furnace(kMany)), some = Render(Furnace(roulette));
  EXPECT_LT(some.rays.counts[std::size_t(RayKind::Shadow)],
            all.rays.counts[std::size_t(RayKind::Shadow)] / 2);
}

TEST(Igi, ScalesIndirectLightAlone) {
  const TestRender one = Render(Furnace(kMany)),
                   two = Render(Furnace(kMany + "\"float indirectscale\" 2"));
  EXPECT_EQ(MeanChannel(two.image, "direct.R"), MeanChannel(one.image, "direct.R"));
  EXPECT_EQ(MeanChannel(two.image, "indirect.R"), 2 * MeanChannel(one.image, "indirect.R"));
  const TestRender none = Render(Furnace("\"float indirectscale\" 0"));
  EXPECT_EQ(MeanChannel(none.image, "indirect.R"), 0);
}

// Russian roulette begins at the third point, with survival .5: a path has 3 + 1 points on average.
TEST(Igi, TracesTheStatedNumberOfLightPaths) {
  const double lights = Render(Furnace("")).Counter("igi/virtual lights");
  EXPECT_NEAR(lights / (64 * 4 * 4), 1, .1);
  const double more =
      Render(Furnace("\"integer nlights\" 600 \"integer nsets\" 3")).Counter("igi/virtual lights");
  EXPECT_NEAR(more / (1800 * 4), 1, .05);
}

// Each light path in the closed sphere leaves a virtual light at the end of each ray.
TEST(Igi, CountsTheRaysOfItsLightPaths) {
  const TestRender render = Render(Furnace("\"integer nlights\" 600 \"integer nsets\" 3"));
  const double rays = double(render.rays.counts[std::size_t(RayKind::Photon)]);
  EXPECT_GE(rays, render.Counter("igi/virtual lights") - 1800);
  EXPECT_GT(rays, 1800);
}

TEST(Igi, GivesTheSameBitsForAnyThreadsTilesAndCrop) {
  for (const std::string parameters : {"", "\"float glimit\" .5 \"integer gathersamples\" 2"}) {
    const std::string scene = Furnace("\"integer nlights\" 100 " + parameters, 4);
    const Image one = Render(scene).image;
    TestRenderOptions options;
    options.threads = 4;
    options.tileSize = 3;
    options.tileOrder = TileOrder::Reversed;
    options.load.pixelBounds = PixelBounds{2, 1, 7, 6};
    const Image crop = RenderSceneText(scene, options).image;
    for (int y = 0; y < crop.Height(); ++y)
      for (int x = 0; x < crop.Width(); ++x)
        for (int c = 0; c < 4; ++c) ASSERT_EQ(crop.At(x, y, c), one.At(x + 2, y + 1, c));
  }
}

// A matte room with a block, seen from its open side; nothing is specular.
std::string Room(const std::string& integrator, int samples, const std::string& more = "") {
  const auto quad = [](const std::string& points) {
    return "Shape \"trianglemesh\" \"integer indices\" [0 1 2 0 2 3] \"point P\" [" + points +
           "]\n";
  };
  return TestHeader(integrator, 15, 15, samples) + "WorldBegin\n" + more +
         "Material \"matte\" \"color Kd\" [.7 .6 .5]\n" + quad("-2 -2 0  2 -2 0  2 -2 5  -2 -2 5") +
         quad("-2 2 0  2 2 0  2 2 5  -2 2 5") + quad("-2 -2 5  2 -2 5  2 2 5  -2 2 5") +
         quad("-2 -2 0  -2 -2 5  -2 2 5  -2 2 0") + quad("2 -2 0  2 -2 5  2 2 5  2 2 0") +
         "AttributeBegin\nAreaLightSource \"area\" \"color L\" [3 3 3]\n" +
         quad("-1 1.9 2  1 1.9 2  1 1.9 4  -1 1.9 4") + "AttributeEnd\nTranslate 0 -1 3\n" +
         "Shape \"sphere\" \"float radius\" .8\nWorldEnd\n";
}

TEST(Igi, AgreesWithPathTracingInAMatteRoom) {
  const std::string lights =
      "\"igi\" \"integer nlights\" 256 \"integer nsets\" 64 \"float mindist\" .02 ";
  EXPECT_TRUE(AgreeInBlocks(.03, EstimateBlocks(Room(lights, 32)),
                            EstimateBlocks(Room("\"path\" \"integer maxdepth\" 30", 256))));
}

// The blocks of the film are 5 pixels wide, and a virtual light near a wall brightens a few of
// them.
TEST(Igi, OfAMovingSphereAgreesWithPathTracing) {
  const std::string moving =
      "AttributeBegin\nMaterial \"matte\"\nActiveTransform EndTime\nTranslate .8 0 0\n"
      "ActiveTransform All\nTranslate -.9 .6 3\nShape \"sphere\" \"float radius\" .6\n"
      "AttributeEnd\n";
  const std::string lights =
      "\"igi\" \"integer nlights\" 256 \"integer nsets\" 64 \"float mindist\" .02 ";
  EXPECT_TRUE(AgreeInBlocks(.05, EstimateBlocks(Room(lights, 32, moving)),
                            EstimateBlocks(Room("\"path\" \"integer maxdepth\" 30", 256, moving))));
}

// All indirect light passes the adjoint BSDF of the floor, whose shading normals are tilted.
TEST(Igi, OverTiltedNormalsHasTheIndirectLightOfPathTracing) {
  const std::string tilted =
      "Material \"matte\" \"color Kd\" [.8 .8 .8]\nShape \"trianglemesh\" \"integer indices\" [0 1 "
      "2 0 2 3] \"point P\" [-2 -1.9 0  2 -1.9 0  2 -1.9 5  -2 -1.9 5] \"normal N\" [.8 .6 0  .8 "
      ".6 "
      "0  .8 .6 0  .8 .6 0]\n";
  const auto indirect = [&](const std::string& integrator, int samples) {
    return EstimateOverSeeds([&](std::uint64_t seed) {
      return MeanChannel(Render(Room(integrator, samples, tilted), seed).image, "indirect.G");
    });
  };
  const std::string lights =
      "\"igi\" \"integer nlights\" 256 \"integer nsets\" 64 \"float mindist\" .02";
  EXPECT_TRUE(
      IsWithin(.03, indirect(lights, 32), indirect("\"path\" \"integer maxdepth\" 30", 256).mean));
}

TEST(Igi, ReportsThatItLeavesCausticsOut) {
  const LoadedScene scene = LoadSceneText(Furnace(""));
  const auto lines = scene.setup->integrator->Explain(*scene.setup->scene);
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_NE(lines[0].find("4 sets of 64"), std::string::npos);
  EXPECT_FALSE(scene.setup->integrator->ComputedFeatures().Has(Feature::Caustics));
}

}  // namespace
}  // namespace exphoton
