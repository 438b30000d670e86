// SPDX-License-Identifier: BSD-2-Clause
// These tests check specular trees. Rays that reflect and refract at every hit must not double
// without end, and Russian roulette must not change the mean of the picture.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/equivalence.h"
#include "tests/support/test_scene.h"

namespace exphoton {
namespace {

// Returns three shells of the material around the camera and a small sphere beside it, in a sky
// of radiance 1.
std::string Shells(const std::string& material) {
  return "WorldBegin\nLightSource \"infinite\"\nMaterial " + material +
         "\nShape \"sphere\" Shape \"sphere\" \"float radius\" 2 Shape \"sphere\" \"float "
         "radius\" 3\nTranslate .3 0 0 Shape \"sphere\" \"float radius\" .2\nWorldEnd\n";
}

TestRender RenderShells(const std::string& material, int maxDepth, std::uint64_t seed,
                        int samples) {
  TestRenderOptions options;
  options.seed = seed;
  return RenderSceneText(
      TestHeader("\"directlighting\" \"integer maxdepth\" " + std::to_string(maxDepth), 8, 8,
                 samples) +
          Shells(material),
      options);
}

double RaysPerSample(const TestRender& render) {
  return double(render.rays.counts[std::size_t(RayKind::Specular)]) /
         double(render.rays.counts[std::size_t(RayKind::Camera)]);
}

const std::string kUber =
    "\"uber\" \"color Kd\" [0 0 0] \"color Ks\" [0 0 0] \"color Kr\" [.5 .5 "
    ".5] \"color opacity\" [.5 .5 .5]";

TEST(SpecularTree, OfMaterialsThatReflectAndTransmitEndsInTime) {
  for (const char* material :
       {kUber.c_str(), "\"glass\" \"color Kr\" [1 1 1] \"color Kt\" [1 1 1]"}) {
    for (const int depth : {20, 200}) {
      const TestRender render = RenderShells(material, depth, 1, 1);
      EXPECT_LT(RaysPerSample(render), 200) << material << ' ' << depth;
    }
  }
}

// Inside each of the three shells is glass, so each shell multiplies the radiance by the squared
// index. The glass absorbs nothing and the sky is uniform, so nothing else changes the radiance.
TEST(SpecularTree, LosesAndAddsNoLightByRoulette) {
  const auto mean = EstimateOverSeeds([](std::uint64_t seed) {
    return MeanRadiance(
        RenderShells("\"glass\" \"color Kr\" [1 1 1] \"color Kt\" [1 1 1]", 500, seed, 256).image);
  });
  EXPECT_TRUE(IsWithin(0.002, mean, std::pow(1.5, 6)));
}

TEST(SpecularTree, UpToDepth5HasNoNoiseOfRoulette) {
  // Two lobes at each of five hits give at most 62 rays. All of them are followed for every seed.
  for (const std::uint64_t seed : {1, 2, 3}) {
    const TestRender render = RenderShells(kUber, 5, seed, 1);
    EXPECT_EQ(RaysPerSample(render), RaysPerSample(RenderShells(kUber, 5, seed + 10, 1)));
    EXPECT_LE(RaysPerSample(render), 62);
    EXPECT_GT(RaysPerSample(render), 15);
  }
}

}  // namespace
}  // namespace exphoton
