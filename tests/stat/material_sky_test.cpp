// SPDX-License-Identifier: BSD-2-Clause
// A sphere of each material under a sky of radiance 1, by the path tracer: what absorbs nothing is
// invisible, what absorbs shows its albedo. Equivalence over 8 seeds (tests/support/equivalence.h).
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

// In each pixel, not only in the mean: rays go straight through.
TEST(MaterialUnderSky, GlassOfIndexOneIsInvisibleInEveryPixel) {
  for (const char* index : {"1", "1.0000001"}) {
    const TestRender render =
        RenderSceneText(SphereUnderSky(R"("glass" "float index" )" + std::string(index), 4));
    for (int y = 0; y < 16; ++y)
      for (int x = 0; x < 16; ++x) EXPECT_NEAR(render.image.At(x, y, 0), 1, 1e-3);
  }
}

// The camera sees the whole sky through the sphere's surroundings and the albedo on it: black gives
// the share of the picture that the sphere covers.
TEST(MaterialUnderSky, GreyMatteShowsItsAlbedo) {
  const double black = Mean(R"("matte" "color Kd" [0 0 0])", 32).mean;
  EXPECT_TRUE(IsWithin(.01, Mean(R"("matte" "color Kd" [.5 .5 .5])", 32), (1 + black) / 2));
}

}  // namespace
}  // namespace exphoton
