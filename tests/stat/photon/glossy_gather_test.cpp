// SPDX-License-Identifier: BSD-2-Clause
// These tests check the light that gather rays read at glossy surfaces. The first tests use a
// closed form: each material reflects light from one direction to a small disk that sees nothing
// else. The other tests compare boxes of one material and a lamp with path tracing, block by block.
// A furnace hides such errors, because its light comes evenly from all directions. Tolerances:
// equivalence.h.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "core/scattering/material.h"
#include "tests/support/equivalence.h"
#include "tests/support/test_scene.h"

namespace exphoton {
namespace {

// A square of the material at z = 0 lies under distant light. A disk at (0, 0, 1) faces down. The
// disk is so small that its shadow and its light on the square do not matter (.1 %). The rim of the
// square, where density estimates lose light, is far away.
constexpr double kHalf = 4, kDiskAlbedo = .2;

std::string SquareUnderOneDirection(const std::string& material, double degrees) {
  const double angle = degrees * M_PI / 180;
  return "LookAt 0 0 .5  0 0 1  0 1 0\nCamera \"perspective\" \"float fov\" 1\n"
         "Film \"image\" \"integer xresolution\" 8 \"integer yresolution\" 8\n"
         "PixelFilter \"box\"\nSampler \"lowdiscrepancy\" \"integer pixelsamples\" 32\n"
         "SurfaceIntegrator \"exphotonmap\" \"integer directphotons\" 150000 "
         "\"integer indirectphotons\" 50 \"integer maxphotonpaths\" 250000 "
         "\"integer finalgathersamples\" 64 \"integer nused\" 150 \"string photonaim\" "
         "\"off\"\nWorldBegin\n"
         "LightSource \"distant\" \"color L\" [10 10 10] \"point to\" [0 0 0] \"point from\" [" +
         std::to_string(std::sin(angle)) + " 0 " + std::to_string(std::cos(angle)) + "]\n" +
         "AttributeBegin\nMaterial \"matte\" \"color Kd\" [.2 .2 .2]\nTranslate 0 0 1\n"
         "Shape \"disk\" \"float radius\" .03\nAttributeEnd\n"
         "Material " +
         material +
         "\nShape \"trianglemesh\" \"integer indices\" [0 1 2 0 2 3] \"point P\" "
         "[-4 -4 0  4 -4 0  4 4 0  -4 4 0] \"float uv\" [0 0 1 0 1 1 0 1]\nWorldEnd\n";
}

// SquareBsdf is the square's BSDF, made by the material of the scene.
class SquareBsdf {
 public:
  explicit SquareBsdf(const std::string& scene) : loaded_(LoadSceneText(scene)) {
    const Ray down{{Real(.5), Real(.3), Real(.5)}, {0, 0, -1}};
    surface_ = *loaded_.setup->scene->Intersect(RayDifferential(down));
    bsdf_ = surface_.material->Evaluate(&surface_, TransportMode::Radiance, &arena_);
  }
  double F(const Vector3& wo, const Vector3& wi) const { return double(bsdf_->f(wo, wi).g); }

 private:
  LoadedScene loaded_;
  SurfaceInteraction surface_;
  Arena arena_;
  std::optional<Bsdf> bsdf_;
};

// Returns the radiance that the disk reflects: albedo / pi times the irradiance from the square, by
// the midpoint rule over the square.
double DiskRadiance(const std::string& scene, double degrees) {
  constexpr int kSteps = 800;
  constexpr double kSun = 10;
  const SquareBsdf bsdf(scene);
  const double angle = degrees * M_PI / 180;
  const Vector3 wi(Real(std::sin(angle)), 0, Real(std::cos(angle)));
  constexpr double kStep = 2 * kHalf / kSteps;
  double irradiance = 0;
  for (int i = 0; i < kSteps; ++i) {
    for (int j = 0; j < kSteps; ++j) {
      const double x = -kHalf + (i + .5) * kStep, y = -kHalf + (j + .5) * kStep;
      const double d2 = x * x + y * y + 1;
      const double cosine = 1 / std::sqrt(d2);
      const Vector3 wo(Real(-x * cosine), Real(-y * cosine), Real(cosine));
      irradiance += bsdf.F(wo, wi) * cosine * cosine / d2;
    }
  }
  return kDiskAlbedo / M_PI * irradiance * kStep * kStep * kSun * std::cos(angle);
}

struct MaterialCase {
  const char* name;
  const char* text;
};

const MaterialCase kMaterials[] = {
    {"Matte", R"("matte" "color Kd" [.5 .5 .5])"},
    {"Plastic", R"("plastic" "color Kd" [.25 .25 .25] "color Ks" [.5 .5 .5])"},
    {"PlasticPhysical",
     R"("plastic" "color Kd" [.4 .4 .4] "color Ks" [1 1 1] "string fresnel" "physical")"},
    {"Substrate", R"("substrate" "color Kd" [.5 .5 .5] "color Ks" [.05 .05 .05])"},
    {"SubstrateStrong", R"("substrate" "color Kd" [.5 .5 .5] "color Ks" [.5 .5 .5])"},
    {"Metal", R"("metal" "float roughness" .1 "color eta" [1 1 1] "color k" [1 1 1])"},
    {"ShinyMetal", R"("shinymetal" "color Kr" [0 0 0] "color Ks" [.4 .4 .4])"},
    {"Uber", R"("uber" "color Kd" [.25 .25 .25] "color Ks" [.25 .25 .25])"},
    {"Translucent", R"("translucent" "color Kd" [.5 .5 .5] "color Ks" [.2 .2 .2] )"
                    R"("color reflect" [.4 .4 .4] "color transmit" [.4 .4 .4])"},
};

std::string NameOf(const testing::TestParamInfo<MaterialCase>& info) { return info.param.name; }

class OneDirection : public testing::TestWithParam<MaterialCase> {};

// The highlight lies within the square.
TEST_P(OneDirection, IsReflectedWithTheRightEnergyInTheRightDirection) {
  for (const double degrees : {40., 65.}) {
    const std::string scene = SquareUnderOneDirection(GetParam().text, degrees);
    const SeedEstimate mean = EstimateOverSeeds(
        [&](std::uint64_t seed) {
          TestRenderOptions options;
          options.seed = seed;
          return MeanRadiance(RenderSceneText(scene, options).image);
        },
        2 * kGateSeeds);
    EXPECT_TRUE(IsWithin(.01, mean, DiskRadiance(scene, degrees))) << degrees << " degrees";
  }
}

INSTANTIATE_TEST_SUITE_P(Materials, OneDirection, testing::ValuesIn(kMaterials), NameOf);

// --- boxes of one material ---------------------------------------------------

constexpr int kWidth = 32, kHeight = 24, kBlock = 8;

std::string BoxOf(const std::string& material, const std::string& integrator, int samples,
                  const std::string& light) {
  return "LookAt 0 0 -.9  .2 -.1 1  0 1 0\nCamera \"perspective\" \"float fov\" 70\n"
         "Film \"image\" \"integer xresolution\" 32 \"integer yresolution\" 24\n"
         "PixelFilter \"box\"\nSampler \"lowdiscrepancy\" \"integer pixelsamples\" " +
         std::to_string(samples) + "\nSurfaceIntegrator " + integrator + "\nWorldBegin\n" + light +
         "\nMaterial " + material +
         "\nShape \"trianglemesh\" \"integer indices\" [0 1 3 0 3 2 4 6 7 4 7 5 0 4 5 0 5 1 2 3 7 "
         "2 "
         "7 6 0 2 6 0 6 4 1 5 7 1 7 3] \"point P\" [-1 -1 -1 1 -1 -1 -1 1 -1 1 1 -1 -1 -1 1 1 -1 1 "
         "-1 1 1 1 1 1]\nWorldEnd\n";
}

// Returns the means over seeds of the picture's blocks and of the whole picture.
std::vector<SeedEstimate> BlockMeans(const std::string& scene, int seeds) {
  LoadedScene loaded = LoadSceneText(scene);
  std::vector<std::vector<double>> means;
  for (int k = 0; k < seeds; ++k) {
    TestRenderOptions options;
    options.seed = std::uint64_t(k) * 1000 + 1;
    const Image image = RenderLoaded(loaded, options).image;
    std::size_t block = 0;
    means.resize(std::size_t((kWidth / kBlock) * (kHeight / kBlock)) + 1);
    for (int y = 0; y < kHeight; y += kBlock)
      for (int x = 0; x < kWidth; x += kBlock)
        means[block++].push_back(MeanRadiance(image, {x, y, x + kBlock, y + kBlock}));
    means[block].push_back(MeanRadiance(image));
  }
  std::vector<SeedEstimate> estimates;
  for (const auto& ofSeeds : means) estimates.push_back(EstimateFrom(ofSeeds));
  return estimates;
}

constexpr const char* kPoint = R"(LightSource "point" "color I" [3 3 3] "point from" [.3 .5 .2])";
// The ball is so small that BSDF samples rarely hit it, but large enough that some do.
constexpr const char* kBall =
    R"(AttributeBegin AreaLightSource "area" "color L" [20 20 20] Material "matte" "color Kd" [0 0 0]
       Translate .3 .5 .2 Shape "sphere" "float radius" .15 AttributeEnd)";

// The samples are per pixel of exphotonmap; path tracing has 16 times as many.
void ExpectAgreement(const std::string& material, const std::string& light, int samples) {
  constexpr double kBlockTolerance = .035, kPictureTolerance = .012;
  const auto truth = BlockMeans(
      BoxOf(material, R"("path" "integer maxdepth" 100)", 16 * samples, light), kGateSeeds);
  const auto found = BlockMeans(
      BoxOf(material, R"("exphotonmap" "integer causticphotons" 0)", samples, light), kGateSeeds);
  for (std::size_t i = 0; i < truth.size(); ++i) {
    SeedEstimate both = found[i];
    both.halfWidth = std::hypot(both.halfWidth, truth[i].halfWidth);
    const bool isPicture = i + 1 == truth.size();
    EXPECT_TRUE(IsWithin(isPicture ? kPictureTolerance : kBlockTolerance, both, truth[i].mean))
        << (isPicture ? "whole picture" : "block " + std::to_string(i));
  }
}

class GlossyBox : public testing::TestWithParam<MaterialCase> {};

TEST_P(GlossyBox, UnderAPointLightIsAsBrightAsByPathTracing) {
  ExpectAgreement(GetParam().text, kPoint, 16);
}

INSTANTIATE_TEST_SUITE_P(Materials, GlossyBox, testing::ValuesIn(kMaterials), NameOf);

// Rays can hit this lamp, so light samples and BSDF samples share its light.
void ExpectAgreementUnderALamp(const char* name) {
  for (const MaterialCase& material : kMaterials)
    if (std::string(material.name) == name) ExpectAgreement(material.text, kBall, 16);
}
TEST(GlossyGather, ABoxUnderALampIsAsBrightAsByPathTracing) {
  ExpectAgreementUnderALamp("Plastic");
}
// ctest calls a test long if its name begins with this word.
TEST(LongGlossyGather, MoreBoxesUnderALampAreAsBrightAsByPathTracing) {
  ExpectAgreementUnderALamp("SubstrateStrong");
  ExpectAgreementUnderALamp("Metal");
}

// Gather rays that are too short for radiance photons read the maps, of a coat as of all else.
TEST(GlossyGather, ShortRaysReadASurfaceUnderItsCoat) {
  const double degrees = 70;
  std::string scene = SquareUnderOneDirection(
      R"("substrate" "color Kd" [.5 .5 .5] "color Ks" [.05 .05 .05])", degrees);
  const std::string aim = "\"string photonaim\"";
  scene.insert(scene.find(aim), "\"float shortrays\" 1000 ");
  const std::string samples = "\"integer pixelsamples\" 32";  // density estimates take long
  scene.replace(scene.find(samples), samples.size(), "\"integer pixelsamples\" 4");
  const SeedEstimate mean = EstimateOverSeeds([&](std::uint64_t seed) {
    TestRenderOptions options;
    options.seed = seed;
    return MeanRadiance(RenderSceneText(scene, options).image);
  });
  EXPECT_TRUE(IsWithin(.02, mean, DiskRadiance(scene, degrees)));
}

// Where gather rays choose between a mirror and its gloss, both keep their share of the light.
TEST(GlossyGather, AMirrorWithAGlossIsAsBrightAsByPathTracing) {
  const auto mean = [](const std::string& integrator, int samples) {
    const std::string scene =
        TestHeader(integrator, 4, 4, samples) +
        FurnaceWorld(1, R"("shinymetal" "color Kr" [.4 .4 .4] "color Ks" [.3 .3 .3])");
    return EstimateOverSeeds([&](std::uint64_t seed) {
      TestRenderOptions options;
      options.seed = seed;
      return MeanRadiance(RenderSceneText(scene, options).image);
    });
  };
  const double truth = mean(R"("path" "integer maxdepth" 60)", 256).mean;
  EXPECT_TRUE(IsWithin(.02, mean(R"("exphotonmap" "integer maxdepth" 60)", 8), truth));
}

// A glossy plate over a small floor is lit over a mirror alone: by a lamp that faces the mirror.
// What gather rays from the floor see of this light is what the caustic map holds, and nothing
// besides.
TEST(GlossyGather, LightOverAMirrorIsLeftToTheCausticMap) {
  const auto indirect = [](const std::string& causticPhotons) {
    TestRenderOptions options;
    options.aovs = kLightAovs;
    const std::string scene = R"(LookAt 0 0 .5  0 0 0  0 1 0
Camera "perspective" "float fov" 20
Film "image" "integer xresolution" 4 "integer yresolution" 4
PixelFilter "box" Sampler "lowdiscrepancy" "integer pixelsamples" 64
SurfaceIntegrator "exphotonmap" "integer directphotons" 2000 "integer indirectphotons" 100
  "integer maxphotonpaths" 300000 "integer finalgathersamples" 64 "integer causticphotons" )" +
                              causticPhotons + R"(
WorldBegin
Material "matte" "color Kd" [.01 .01 .01] Shape "disk" "float radius" .5
Material "mirror" "color Kr" [1 1 1] Shape "disk" "float radius" 4 "float innerradius" .6
Material "metal" "float roughness" .005 Shape "disk" "float height" 2 "float radius" 2
Material "matte" "color Kd" [0 0 0] Translate 1.5 0 1 ReverseOrientation
AreaLightSource "area" "color L" [30 30 30] Shape "disk" "float radius" .4
WorldEnd
)";
    return MeanChannel(RenderSceneText(scene, options).image, "indirect.G");
  };
  const double with = indirect("20000");
  EXPECT_GT(with, 0);
  EXPECT_LT(indirect("0"), .1 * with);
}

// --- single cases ------------------------------------------------------------

TEST(GlossyGather, APlasticSphereWithALightInItsMiddleIsNotTooBright) {
  const auto mean = [](const std::string& integrator, int samples) {
    const std::string scene =
        "LookAt 0 0 -.5 0 0 1 0 1 0\nCamera \"perspective\" \"float fov\" 60\n"
        "Film \"image\" \"integer xresolution\" 8 \"integer yresolution\" 8\nPixelFilter \"box\"\n"
        "Sampler \"lowdiscrepancy\" \"integer pixelsamples\" " +
        std::to_string(samples) + "\nSurfaceIntegrator " + integrator +
        "\nWorldBegin\nLightSource \"point\" \"color I\" [3 3 3]\n"
        "Material \"plastic\" \"color Kd\" [.25 .25 .25] \"color Ks\" [.5 .5 .5]\n"
        "ReverseOrientation Shape \"sphere\" \"float radius\" 1\nWorldEnd\n";
    return EstimateOverSeeds([&](std::uint64_t seed) {
      TestRenderOptions options;
      options.seed = seed;
      return MeanRadiance(RenderSceneText(scene, options).image);
    });
  };
  const SeedEstimate truth = mean(R"("path" "integer maxdepth" 100)", 512);
  SeedEstimate found = mean(R"("exphotonmap" "integer indirectphotons" 60000)", 8);
  found.halfWidth = std::hypot(found.halfWidth, truth.halfWidth);
  EXPECT_TRUE(IsWithin(.01, found, truth.mean));
}

// Metal has no diffuse lobe, so no radiance photon lies on it.
TEST(GlossyGather, WithoutTheEffectGlossyLobesSendNothingToGatherRays) {
  const auto indirect = [](const char* effects) {
    TestRenderOptions options;
    options.load.effects = effects;
    options.aovs = {Aov::Indirect};
    return MeanChannel(
        RenderSceneText(BoxOf(kMaterials[5].text, "\"exphotonmap\"", 4, kPoint), options).image,
        "indirect.R");
  };
  EXPECT_GT(indirect("auto"), .01);
  EXPECT_EQ(indirect("glossy=off"), 0);
}

}  // namespace
}  // namespace exphoton
