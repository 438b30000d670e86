// SPDX-License-Identifier: BSD-2-Clause
// These tests check each condition of feature culling, with scenes for which a wrong condition
// would fail. The feature must be on or off as stated. The picture must be the same, bit for bit,
// with all features on.
#include <gtest/gtest.h>

#include <array>
#include <cstdlib>
#include <filesystem>
#include <string>

#include "core/imaging/files/exr.h"
#include "tests/support/test_scene.h"

namespace exphoton {
namespace {

const std::string kIndirectBox =
    "Shape \"trianglemesh\" \"integer indices\" [0 1 3 0 3 2 4 6 7 4 7 5 0 4 5 0 5 1 2 3 7 2 7 6 "
    "0 2 6 0 6 4 1 5 7 1 7 3] \"point P\" [-1 -1 -1 1 -1 -1 -1 1 -1 1 1 -1 -1 -1 1 1 -1 1 -1 1 1 "
    "1 1 1]\n";
const std::string kMatteBox = "Material \"matte\" \"color Kd\" [.5 .5 .5]\n" + kIndirectBox;
const std::string kLamp = "LightSource \"point\" \"point from\" [.5 .8 -.3]\n";
const std::string kGlow =
    "Volume \"homogeneous\" \"color Le\" [2 2 2] \"point p0\" [-.4 -.4 -.4] \"point p1\" [.4 .4 "
    ".4]\n";
const std::string kBall = "Translate .3 0 .4 Shape \"sphere\" \"float radius\" .4\n";
const std::string kEqualBlend =
    "Texture \"by place\" \"float\" \"bilerp\" \"float v00\" -.4 \"float v01\" -.1\n";

// Condition is a world with the expected state of one feature.
struct Condition {
  std::string name, world;
  Feature effect;
  bool on;
  std::string header = "";  // text before the camera
  std::string camera = "";  // camera parameters
};

std::string TextOf(const Condition& c, const std::string& integrator, int indirectPhotons = 500) {
  std::string text = "SurfaceIntegrator " + integrator;
  if (integrator.find("photonmap") != std::string::npos)
    text += " \"integer causticphotons\" 500 \"integer indirectphotons\" " +
            std::to_string(indirectPhotons) +
            " \"integer maxphotonpaths\" 5000 \"integer finalgathersamples\" 8";
  return text +
         "\nFilm \"image\" \"integer xresolution\" 8 \"integer yresolution\" 6\n"
         "PixelFilter \"box\"\nSampler \"lowdiscrepancy\" \"integer pixelsamples\" 4\n" +
         c.header + "Translate 0 0 .9 Camera \"perspective\"" + c.camera + "\nWorldBegin\n" +
         c.world + "WorldEnd\n";
}

class PlanCondition : public testing::TestWithParam<Condition> {};

TEST_P(PlanCondition, IsTrueOfThisScene) {
  const LoadedScene scene = LoadSceneText(TextOf(GetParam(), "\"exphotonmap\""));
  const RequiredFeatures::Row row = scene.setup->scene->Features().Get(GetParam().effect);
  EXPECT_EQ(row.on, GetParam().on) << row.reason;
  TestRenderOptions all;
  all.load.effects = "all";
  for (const char* integrator :
       {"\"exphotonmap\"", "\"photonmap\"", "\"path\"", "\"directlighting\"", "\"whitted\"",
        "\"guidedpath\" \"integer indirectphotons\" 2000", "\"bidirectional\"", "\"igi\"",
        "\"irradiancecache\" \"integer nsamples\" 16"}) {
    const std::string text = TextOf(GetParam(), integrator);
    EXPECT_EQ(RenderSceneText(text).image.pixels, RenderSceneText(text, all).image.pixels)
        << integrator;
  }
}

INSTANTIATE_TEST_SUITE_P(
    Light, PlanCondition,
    testing::Values(
        Condition{"GlowOnMatte", kGlow + kMatteBox, Feature::Indirect, true},
        Condition{"GlowOnGloss", kGlow + "Material \"plastic\"\n" + kIndirectBox, Feature::Glossy,
                  true},
        Condition{"GlowThroughTranslucent",
                  kGlow + kMatteBox + "Material \"translucent\"\n" + kBall, Feature::Transmission,
                  true},
        Condition{"GlowOnMirrorMakesNoCaustic", kGlow + kMatteBox + "Material \"mirror\"\n" + kBall,
                  Feature::Caustics, false},
        Condition{"GlowOnMirror", kGlow + kMatteBox + "Material \"mirror\"\n" + kBall,
                  Feature::Specular, true},
        Condition{"FogWithoutLight",
                  "Volume \"homogeneous\" \"color sigma_s\" [1 1 1] \"point p0\" [-1 -1 -1]\n" +
                      kMatteBox,
                  Feature::Indirect, false, "VolumeIntegrator \"single\"\n"},
        Condition{"FogWithLight",
                  kLamp +
                      "Volume \"homogeneous\" \"color sigma_s\" [1 1 1] \"point p0\" [-1 -1 "
                      "-1]\n" +
                      kMatteBox,
                  Feature::Indirect, true, "VolumeIntegrator \"single\"\n"},
        Condition{"BlackBodyLamp", "LightSource \"point\" \"blackbody I\" [4000 1]\n" + kMatteBox,
                  Feature::Indirect, true},
        Condition{"BlackBodyLampTimesZero",
                  "LightSource \"point\" \"blackbody I\" [4000 0]\n" + kMatteBox, Feature::Indirect,
                  false},
        Condition{"LampBehindGlass",
                  kLamp + kMatteBox +
                      "Material \"glass\" Translate .5 .8 -.3 Shape \"sphere\" "
                      "\"float radius\" .1\n",
                  Feature::Caustics, true},
        Condition{"LampWithinAClosedBody",
                  kLamp + kMatteBox + "Translate .5 .8 -.3 Shape \"sphere\" \"float radius\" .1\n",
                  Feature::Indirect, true},
        Condition{"SkyAround", "LightSource \"infinite\"\nMaterial \"matte\"\n" + kBall,
                  Feature::Environment, true}),
    [](const auto& info) { return info.param.name; });

INSTANTIATE_TEST_SUITE_P(
    Surface, PlanCondition,
    testing::Values(
        Condition{"ZeroInTwoChannels",
                  kLamp + kMatteBox + "Material \"mirror\" \"color Kr\" [0 .5 0]\n" + kBall,
                  Feature::Caustics, true},
        Condition{"BlackBodyReflectance",
                  kLamp + kMatteBox + "Material \"mirror\" \"blackbody Kr\" [3000 .2]\n" + kBall,
                  Feature::Specular, true},
        Condition{"ProductOfTextureAndZero",
                  kLamp + kMatteBox +
                      "Texture \"board\" \"color\" \"checkerboard\"\n"
                      "Texture \"none\" \"color\" \"scale\" \"texture tex1\" \"board\" "
                      "\"color tex2\" [0 0 0]\nMaterial \"mirror\" \"texture Kr\" \"none\"\n" +
                      kBall,
                  Feature::Specular, false},
        Condition{"OpacityBlendedFromOneAndOne",
                  kLamp + kMatteBox + kEqualBlend +
                      "Texture \"one\" \"color\" \"mix\" \"color tex1\" [1 1 1] \"color tex2\" [1 "
                      "1 1] \"texture amount\" \"by place\"\n"
                      "Material \"uber\" \"texture opacity\" \"one\"\n" +
                      kBall,
                  Feature::Specular, false},
        Condition{"OpacityBetweenFourOnes",
                  kLamp + kMatteBox +
                      "Texture \"one\" \"color\" \"bilerp\" \"color v00\" [1 1 1] \"color v01\" [1 "
                      "1 1] \"color v10\" [1 1 1] \"color v11\" [1 1 1]\n"
                      "Material \"uber\" \"texture opacity\" \"one\"\n" +
                      kBall,
                  Feature::Specular, false},
        Condition{"OpacityOfEqualChecks",
                  kLamp + kMatteBox +
                      "Texture \"one\" \"color\" \"checkerboard\" \"float uscale\" 9 "
                      "\"color tex1\" [1 1 1] \"color tex2\" [1 1 1]\n"
                      "Material \"uber\" \"texture opacity\" \"one\"\n" +
                      kBall,
                  Feature::Specular, false},
        Condition{"IndexBlendedFromOneAndOne",
                  kLamp + kMatteBox + kEqualBlend +
                      "Texture \"one\" \"float\" \"mix\" \"float tex1\" 1 \"float tex2\" 1 "
                      "\"texture amount\" \"by place\"\n"
                      "Material \"glass\" \"texture index\" \"one\" \"color Kt\" [0 0 0]\n" +
                      kBall,
                  Feature::Specular, false},
        Condition{"MirrorOfOneShapeAlone",
                  kLamp + kMatteBox +
                      "Material \"mirror\" \"color Kr\" [0 0 0]\nTranslate .3 0 .4 "
                      "Shape \"sphere\" \"float radius\" .4 \"color Kr\" [1 1 1]\n",
                  Feature::Specular, true},
        Condition{"MirrorInAnObject",
                  kLamp + kMatteBox +
                      "ObjectBegin \"o\" Material \"mirror\" Shape \"sphere\" "
                      "\"float radius\" .4 ObjectEnd ObjectInstance \"o\"\n",
                  Feature::Caustics, true},
        Condition{"BumpsAlone",
                  kLamp +
                      "Texture \"bumps\" \"float\" \"bilerp\" \"float v01\" .4\nMaterial "
                      "\"matte\" \"texture bumpmap\" \"bumps\"\n" +
                      kIndirectBox + kBall,
                  Feature::Filtering, true},
        Condition{"FilteredRoughnessAlone",
                  kLamp +
                      "Texture \"rough\" \"float\" \"checkerboard\" \"float tex1\" .1 \"float "
                      "tex2\" .5 \"float uscale\" 9\nMaterial \"metal\" \"texture "
                      "roughness\" \"rough\"\n" +
                      kIndirectBox + kBall,
                  Feature::Filtering, true},
        Condition{"FilteredAmountAlone",
                  kLamp +
                      "Texture \"amount\" \"float\" \"checkerboard\" \"float uscale\" 9\n"
                      "Texture \"blend\" \"color\" \"mix\" \"texture amount\" \"amount\"\n"
                      "Material \"matte\" \"texture Kd\" \"blend\"\n" +
                      kIndirectBox + kBall,
                  Feature::Filtering, true}),
    [](const auto& info) { return info.param.name; });

const std::string kMovingBall =
    kLamp + kMatteBox + "ActiveTransform EndTime Translate .3 .2 0 ActiveTransform All\n" + kBall;

INSTANTIATE_TEST_SUITE_P(
    Time, PlanCondition,
    testing::Values(
        Condition{"MovesBeforeTheShutterOpens", kMovingBall, Feature::Motion, false,
                  "TransformTimes 0 .2\n", " \"float shutteropen\" .25 \"float shutterclose\" .5"},
        Condition{"MovesAfterTheShutterCloses", kMovingBall, Feature::Motion, false,
                  "TransformTimes .6 .8\n", " \"float shutteropen\" .25 \"float shutterclose\" .5"},
        Condition{"MovesWithinTheExposure", kMovingBall, Feature::Motion, true,
                  "TransformTimes .3 .4\n", " \"float shutteropen\" .25 \"float shutterclose\" .5"},
        Condition{"CameraAloneMoves", kLamp + kMatteBox, Feature::Motion, true,
                  "ActiveTransform EndTime Rotate 20 0 1 0 ActiveTransform All\n"},
        Condition{"ShutterIsClosed", kMovingBall, Feature::Motion, false, "",
                  " \"float shutteropen\" .5 \"float shutterclose\" .5"},
        Condition{"LensOfASmallRadius", kLamp + kMatteBox, Feature::Lens, true, "",
                  " \"float lensradius\" 1e-6 \"float focaldistance\" 1"}),
    [](const auto& info) { return info.param.name; });

// Without specular surfaces, feature culling clears the target of the caustic map, which is the
// smallest one here. Photons of the sun start at the same places nevertheless.
TEST(PlanOfEffects, KeepsTheStartsOfPhotonsThatAreAimed) {
  const Condition sun{"Sun",
                      "LightSource \"distant\" \"point from\" [1 1 -4] \"point to\" [0 0 0]\n"
                      "Material \"matte\" Translate 0 0 1 Shape \"disk\" \"float radius\" 50\n"
                      "Translate 0 0 -.5 Shape \"sphere\" \"float radius\" .3\n",
                      Feature::Caustics, false};
  TestRenderOptions all;
  all.load.effects = "all";
  for (const char* integrator : {"\"exphotonmap\"", "\"photonmap\""}) {
    const std::string text =
        TextOf(sun, std::string(integrator) + " \"string photonaim\" \"on\"", 20000);
    const TestRender render = RenderSceneText(text);
    EXPECT_TRUE(render.Says("start towards visible points")) << integrator;
    EXPECT_EQ(render.image.pixels, RenderSceneText(text, all).image.pixels) << integrator;
  }
}

// A sky whose mean underflows to 0 is not provably black.
TEST(PlanOfEffects, KeepsASkyWithOneFaintTexel) {
  const std::filesystem::path folder =
      std::filesystem::temp_directory_path() / "exphoton-faint-sky";
  std::filesystem::create_directories(folder);
  const std::string map = folder / "map.exr";
  Image image(64, 32, {"R", "G", "B"});
  image.pixels[3 * (64 * 20 + 8)] = 1e-35f;
  WriteExr(map, image, false);
  const Condition sky{
      "Sky",
      "LightSource \"infinite\" \"color L\" [2e-9 2e-9 2e-9] \"string mapname\" \"" + map +
          "\"\nMaterial \"matte\"\n" + kBall,
      Feature::Environment, true};
  const LoadedScene scene = LoadSceneText(TextOf(sky, "\"path\""));
  EXPECT_EQ(scene.setup->scene->NonBlackLightCount(), 1);
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace exphoton
