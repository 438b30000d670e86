// SPDX-License-Identifier: BSD-2-Clause
// These tests path-trace a sphere of each material under a sky of radiance 1. A material that
// absorbs nothing is invisible, and a material that absorbs shows its albedo. The tests use the
// equivalence rule over 8 seeds (tests/support/equivalence.h).
#include <cmath>
#include <fstream>

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

// Parallel rays that fill the outline of a sphere arrive there as a uniform sky does, weighted by
// the cosine. The mean over the sphere is therefore the hemispherical reflectance, for any BRDF.
// The reflectances of the fits are those of decision record 25, by quadrature.
struct Reflectance {
  const char* name;
  std::string material;
  double red, green, blue;
};
class FurnaceOfMaterial : public testing::TestWithParam<Reflectance> {};

TEST_P(FurnaceOfMaterial, ShowsItsReflectance) {
  const std::string scene =
      "SurfaceIntegrator \"path\" \"integer maxdepth\" 5\nFilm \"image\" \"integer xresolution\" "
      "16 \"integer yresolution\" 16\nPixelFilter \"box\"\nSampler \"lowdiscrepancy\" \"integer "
      "pixelsamples\" 128\nTranslate 0 0 3\nCamera \"orthographic\"\nWorldBegin\nLightSource "
      "\"infinite\"\n" +
      GetParam().material + "Shape \"sphere\"\nWorldEnd\n";
  const double truth[] = {GetParam().red, GetParam().green, GetParam().blue};
  const char* const channels[] = {"R", "G", "B"};
  for (int c = 0; c < 3; ++c) {
    const SeedEstimate estimate = EstimateOverSeeds([&](std::uint64_t seed) {
      TestRenderOptions options;
      options.seed = seed;
      return MeanChannel(RenderSceneText(scene, options).image, channels[c]);
    });
    EXPECT_TRUE(IsWithin(.01, estimate, 1 - M_PI / 4 * (1 - truth[c]))) << channels[c];
  }
}

std::string WriteConstantMeasurement() {
  const std::string path = testing::TempDir() + "exphoton_constant.brdf";
  std::ofstream(path) << "1 550\n.3 0 .4 1 .2\n";
  return path;
}

INSTANTIATE_TEST_SUITE_P(
    All, FurnaceOfMaterial,
    testing::Values(
        Reflectance{"matte", "Material \"matte\" \"color Kd\" [.2 .5 .8]\n", .2, .5, .8},
        Reflectance{"bluepaint", "Material \"bluepaint\"\n", .333, .420, .739},
        Reflectance{"brushedmetal", "Material \"brushedmetal\"\n", .762, .773, .819},
        Reflectance{"clay", "Material \"clay\"\n", .412, .288, .300},
        Reflectance{"felt", "Material \"felt\"\n", .029, .029, .029},
        Reflectance{"primer", "Material \"primer\"\n", .188, .191, .202},
        Reflectance{"skin", "Material \"skin\"\n", .487, .361, .388},
        // A constant of .2 per steradian is a Lambertian surface of .2 pi. A constant spectrum has
        // X = Y = Z = 1, which is not quite white.
        Reflectance{
            "measured",
            "Material \"measured\" \"string filename\" \"" + WriteConstantMeasurement() + "\"\n",
            .2 * M_PI * 1.2048, .2 * M_PI * .9483, .2 * M_PI * .9089},
        Reflectance{"mix",
                    "MakeNamedMaterial \"a\" \"string type\" \"matte\" \"color Kd\" [.8 .4 "
                    ".2]\nMakeNamedMaterial \"b\" \"string type\" \"mirror\" \"color Kr\" [.5 .6 "
                    ".7]\nMaterial \"mix\" \"string namedmaterial1\" \"a\" \"string "
                    "namedmaterial2\" \"b\" \"color amount\" [.25 .5 1]\n",
                    .25 * .8 + .75 * .5, .5, .2}),
    [](const auto& info) { return std::string(info.param.name); });

}  // namespace
}  // namespace exphoton
