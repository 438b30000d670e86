// SPDX-License-Identifier: BSD-2-Clause
// These tests path-trace a sphere of each material under a sky of radiance 1. A material that
// absorbs nothing is invisible, and a material that absorbs shows its albedo. The tests use the
// equivalence rule over 8 seeds (tests/support/equivalence.h).
#include "tests/support/equivalence.h"
#include "tests/support/test_scene.h"

namespace exphoton {
namespace {

std::string SphereUnderSky(const std::string& material, int samples) {
  return TestHeader(R"("path" "integer maxdepth" 100)", 16, 16, samples) +
         "WorldBegin\nLightSource \"infinite\" \"color L\" [1 1 1]\nMaterial " + material +
         "\nTranslate 0 0 1.3\nRotate 37 1 2 3\nShape \"sphere\" \"float radius\" 1\nWorldEnd\n";
}

SeedEstimate Mean(const std::string& material, int samples) {
  return EstimateOverSeeds([&](std::uint64_t seed) {
    TestRenderOptions options;
    options.seed = seed;
    return MeanRadiance(RenderSceneText(SphereUnderSky(material, samples), options).image);
  });
}

TEST(MaterialUnderSky, WhiteMatteIsInvisible) {
  EXPECT_TRUE(IsWithin(.01, Mean(R"("matte")", 32), 1));
}

TEST(MaterialUnderSky, WhiteTranslucentWithoutGlossIsInvisible) {
  EXPECT_TRUE(IsWithin(.01, Mean(R"("translucent" "color Ks" [0 0 0])", 32), 1));
}

TEST(MaterialUnderSky, HalfOpaqueWhiteUberIsInvisible) {
  EXPECT_TRUE(
      IsWithin(.01, Mean(R"("uber" "color Ks" [0 0 0] "color opacity" [.4 .4 .4])", 32), 1));
}

TEST(MaterialUnderSky, PerfectMirrorIsInvisible) {
  EXPECT_TRUE(IsWithin(1e-5, Mean(R"("mirror")", 4), 1));
}

TEST(MaterialUnderSky, ClearGlassIsInvisible) {
  EXPECT_TRUE(IsWithin(.02, Mean(R"("glass")", 64), 1));
}

// Every pixel must be right, not only the mean, because rays go straight through.
TEST(MaterialUnderSky, GlassOfIndexOneIsInvisibleInEveryPixel) {
  for (const char* index : {"1", "1.0000001"}) {
    const TestRender render =
        RenderSceneText(SphereUnderSky(R"("glass" "float index" )" + std::string(index), 4));
    for (int y = 0; y < 16; ++y)
      for (int x = 0; x < 16; ++x) EXPECT_NEAR(render.image.At(x, y, 0), 1, 1e-3);
  }
}

// The picture shows the sky around the sphere and the albedo on the sphere. With a black sphere,
// the mean is the fraction of the picture that the sphere does not cover.
TEST(MaterialUnderSky, GreyMatteShowsItsAlbedo) {
  const double black = Mean(R"("matte" "color Kd" [0 0 0])", 32).mean;
  EXPECT_TRUE(IsWithin(.01, Mean(R"("matte" "color Kd" [.5 .5 .5])", 32), (1 + black) / 2));
}

}  // namespace
}  // namespace exphoton
