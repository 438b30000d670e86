// SPDX-License-Identifier: BSD-2-Clause
// These tests check cases in which the classic photon mapper hangs, crashes or loses
// energy: missing photons, missing lights, surfaces that are all specular, tiny counts, and
// colours that cancel.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "core/base/error.h"
#include "tests/support/test_scene.h"

namespace exphoton {
namespace {

std::string Sphere(const std::string& integrator, const std::string& light,
                   const std::string& material) {
  return TestHeader(integrator, 4, 4, 2) + "WorldBegin\n" + light + "\nMaterial " + material +
         "\nReverseOrientation\nShape \"sphere\" \"float radius\" [1]\nWorldEnd\n";
}

constexpr const char* kPoint = "LightSource \"point\" \"color I\" [1 1 1]";
constexpr const char* kGrey = "\"matte\" \"color Kd\" [.5 .5 .5]";

TEST(PhotonEdgeCases, TinyPhotonCountsRender) {
  for (const char* integrator : {"photonmap", "exphotonmap"})
    for (int indirect : {0, 1, 2, 49, 50, 51})
      for (int caustic : {0, 1, 2}) {
        const std::string settings = std::string("\"") + integrator +
                                     "\" \"integer indirectphotons\" [" + std::to_string(indirect) +
                                     "] \"integer causticphotons\" [" + std::to_string(caustic) +
                                     "]";
        const TestRender render = RenderSceneText(Sphere(settings, kPoint, kGrey));
        EXPECT_EQ(render.result.nonFiniteSamples, 0);
        // Direct light of .5 / pi is always present. All light together is twice this value.
        EXPECT_GT(MeanRadiance(render.image), .159) << settings;
        EXPECT_LT(MeanRadiance(render.image), indirect < 49 ? 5 : .5) << settings;
      }
}

TEST(PhotonEdgeCases, WithoutIndirectPhotonsTheGatherStillReadsDirectAndCausticLight) {
  const auto render = [](const std::string& counts) {
    return MeanRadiance(RenderSceneText(Sphere("\"exphotonmap\" " + counts, kPoint, kGrey)).image);
  };
  const double direct =
      MeanRadiance(RenderSceneText(Sphere("\"directlighting\"", kPoint, kGrey)).image);
  const double once = render("\"integer indirectphotons\" [0] \"integer directphotons\" [20000]");
  // The picture has one bounce more than direct light. The indirect map would add further bounces.
  EXPECT_NEAR(once / direct, 1.5, .05);
}

// In a white sphere no path ends before the limit: the first surface holds a direct photon, each of
// the others an indirect one.
TEST(PhotonEdgeCases, ThePathsOfAWhiteBoxEndAtTheLimit) {
  for (const int limit : {1, 2, 5}) {
    const TestRender render = RenderSceneText(
        Sphere("\"photonmap\" \"integer indirectphotons\" 1000 \"integer maxphotonpaths\" 500 "
               "\"string photonroulette\" \"luminance\" \"integer maxphotondepth\" " +
                   std::to_string(limit),
               kPoint, "\"matte\" \"color Kd\" [1 1 1]"));
    EXPECT_EQ(render.Counter("photons/indirect stored"),
              (limit - 1) * render.Counter("photons/indirect paths"))
        << limit;
  }
}

TEST(PhotonEdgeCases, BlackLightsGiveEmissionOnly) {
  const TestRender render = RenderSceneText(
      Sphere("\"exphotonmap\"", "LightSource \"point\" \"color I\" [0 0 0]", kGrey));
  EXPECT_EQ(MeanRadiance(render.image), 0);
}

TEST(PhotonEdgeCases, WithoutLightsThePictureIsBlack) {
  const TestRender render = RenderSceneText(Sphere("\"exphotonmap\"", "", kGrey));
  EXPECT_EQ(MeanRadiance(render.image), 0);
}

TEST(PhotonEdgeCases, WithoutSpecularSurfacesNoCausticPathIsShot) {
  const TestRender asked = RenderSceneText(
      Sphere("\"exphotonmap\" \"integer causticphotons\" [20000] \"integer indirectphotons\" [500]",
             kPoint, kGrey));
  const TestRender unasked = RenderSceneText(
      Sphere("\"exphotonmap\" \"integer causticphotons\" [0] \"integer indirectphotons\" [500]",
             kPoint, kGrey));
  EXPECT_EQ(asked.image.pixels, unasked.image.pixels);
  EXPECT_LT(asked.Counter("photons/indirect paths"), 1000);
  EXPECT_TRUE(std::isnan(asked.Counter("photons/caustic paths")));
}

TEST(PhotonEdgeCases, AMirrorBoxEnds) {
  const TestRender render = RenderSceneText(
      Sphere("\"exphotonmap\" \"integer indirectphotons\" [1000]", kPoint, "\"mirror\""));
  EXPECT_EQ(MeanRadiance(render.image), 0);
}

TEST(PhotonEdgeCases, AMapThatNeverFillsIsReportedWithWhatItHas) {
  const TestRender render = RenderSceneText(
      Sphere("\"exphotonmap\" \"integer maxphotonpaths\" [640] \"integer indirectphotons\" "
             "[1000000]",
             kPoint, kGrey));
  EXPECT_TRUE(render.Says("indirect map: "));
  EXPECT_TRUE(render.Says("of 1000000 photons after"));
  EXPECT_GT(render.Counter("photons/indirect stored"), 0);
  EXPECT_GT(MeanRadiance(render.image), 0);
}

TEST(PhotonEdgeCases, ComplementaryColoursEndPathsWithoutNan) {
  const TestRender render = RenderSceneText(
      Sphere("\"exphotonmap\" \"integer indirectphotons\" [1000] \"integer maxphotonpaths\" [4096]",
             "LightSource \"point\" \"color I\" [1 0 0]", "\"matte\" \"color Kd\" [0 1 0]"));
  EXPECT_EQ(render.result.nonFiniteSamples, 0);
  EXPECT_EQ(MeanRadiance(render.image), 0);
}

TEST(PhotonEdgeCases, TheDepthLimitWarnsWhereItCutsPower) {
  const auto render = [](int depth) {
    return RenderSceneText(
        Sphere("\"exphotonmap\" \"integer indirectphotons\" [2000] \"integer "
               "maxphotondepth\" [" +
                   std::to_string(depth) + "]",
               kPoint, "\"matte\" \"color Kd\" [.9 .9 .9]"));
  };
  EXPECT_TRUE(render(5).Says("maxphotondepth 5 cut"));
  EXPECT_FALSE(render(1024).Says("maxphotondepth"));
}

TEST(PhotonEdgeCases, TheCamerasDepthLimitWarnsWhereItCuts) {
  const auto render = [](int depth, const char* light) {
    return RenderSceneText(
        Sphere("\"exphotonmap\" \"integer indirectphotons\" [100] \"integer "
               "maxphotonpaths\" [4096] \"integer maxdepth\" [" +
                   std::to_string(depth) + "]",
               light, "\"mirror\" \"color Kr\" [.2 .2 .2]"));
  };
  const char* const lamp =
      "AttributeBegin AreaLightSource \"area\" Translate .3 0 .4 Shape \"sphere\" \"float radius\" "
      ".2 "
      "AttributeEnd";
  EXPECT_TRUE(render(1, lamp).Says("the depth limit \"maxdepth\" cut about"));
  EXPECT_FALSE(render(10, lamp).Says("depth limit"));
  // A mirror shows no light of a point, however often it reflects.
  EXPECT_FALSE(render(1, kPoint).Says("depth limit"));
}

// The lamp lights the whole sphere evenly. The irradiance is 1 from direct light, and 1 from all
// further bounces of albedo 1/2 together.
TEST(PhotonEdgeCases, EveryShownMapHasItsShareOfTheLight) {
  for (const char* integrator : {"photonmap", "exphotonmap"})
    for (const auto& [show, irradiance] : {std::pair<std::string, double>{"radiancephotons", 2},
                                           {"directphotons", 1},
                                           {"indirectphotons", 1}}) {
      const TestRender render = RenderSceneText(Sphere(
          std::string("\"") + integrator +
              "\" \"integer indirectphotons\" [20000] \"float maxdist\" .2 \"string show\" \"" +
              show + "\"",
          kPoint, kGrey));
      EXPECT_NEAR(MeanRadiance(render.image) / (irradiance * .5 / 3.14159265), 1, .06)
          << integrator << " " << show;
    }
}

TEST(PhotonEdgeCases, GatherAnglesOutsideTheirRangeAreErrors) {
  for (const char* angle : {"0", "91", "180", "-5"})
    EXPECT_THROW(
        RenderSceneText(Sphere(std::string("\"exphotonmap\" \"float gatherangle\" [") + angle + "]",
                               kPoint, kGrey)),
        Error)
        << angle;
  EXPECT_NO_THROW(RenderSceneText(
      Sphere("\"exphotonmap\" \"integer indirectphotons\" [100] \"float gatherangle\" [90]", kPoint,
             kGrey)));
}

TEST(PhotonEdgeCases, LightThatHitsNothingEndsWithinItsBudget) {
  const std::string scene =
      TestHeader("\"exphotonmap\" \"integer indirectphotons\" [1000]", 4, 4, 1) +
      "WorldBegin\nLightSource \"spot\" \"point from\" [0 0 5] \"point to\" [0 0 10]\nMaterial " +
      kGrey + "\nTranslate 0 0 3\nShape \"sphere\" \"float radius\" [1]\nWorldEnd\n";
  const TestRender render = RenderSceneText(scene);
  EXPECT_TRUE(render.Says("indirect map: 0 of 1000 photons"));
  EXPECT_EQ(MeanRadiance(render.image), 0);
}

// The power is 4 pi times this intensity, which overflows Real.
constexpr const char* kTooBright = sizeof(Real) == 4
                                       ? "LightSource \"point\" \"color I\" [3e38 3e38 3e38]"
                                       : "LightSource \"point\" \"color I\" [1e308 1e308 1e308]";

TEST(PhotonEdgeCases, PhotonsWithoutFinitePowerAreCountedAndUnderStrictAnError) {
  const std::string text = Sphere(
      "\"photonmap\" \"integer indirectphotons\" 100 "
      "\"integer maxphotonpaths\" 256",
      kTooBright, kGrey);
  TestRenderOptions options;
  options.isStrict = false;
  const TestRender render = RenderSceneText(text, options);
  EXPECT_TRUE(render.Says("photons had no finite power"));
  EXPECT_EQ(render.Counter("photons/non-finite"), render.Counter("photons/shot"));
  options.isStrict = true;
  options.seed = 17;
  try {
    RenderSceneText(text, options);
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.Status(), ExitStatus::Internal);
    EXPECT_STREQ(error.what(), "photon path 0 of seed 17 has a power that is not finite");
  }
}

// Each setting shows one map, so photons for the other maps are not needed.
TEST(PhotonEdgeCases, ShowingAMapShootsThatMapAlone) {
  const std::string world =
      "WorldBegin\n" + std::string(kPoint) +
      "\nMaterial \"matte\"\nReverseOrientation\nShape \"sphere\" \"float radius\" 3\n"
      "Material \"glass\" Translate 0 0 1.5 Shape \"sphere\" \"float radius\" .5\nWorldEnd\n";
  const std::vector<std::string> maps{"direct", "caustic", "indirect"};
  for (const std::string& shown : maps) {
    const TestRender render = RenderSceneText(
        TestHeader("\"exphotonmap\" \"integer causticphotons\" 500 \"integer indirectphotons\" "
                   "500 \"string show\" \"" +
                       shown + "photons\"",
                   8, 8, 1) +
        world);
    for (const std::string& map : maps)
      EXPECT_EQ(render.Counter("photons/" + map + " stored") >= 500, map == shown)
          << map << " while showing " << shown;
    EXPECT_GT(MeanRadiance(render.image), 0) << shown;
  }
}

TEST(PhotonEdgeCases, SaysWhatTheDepthLimitCutsOffGatherRays) {
  const auto render = [](int maxDepth) {
    return RenderSceneText(
        TestHeader("\"photonmap\" \"integer causticphotons\" 0 \"integer indirectphotons\" 2000 "
                   "\"integer maxdepth\" " +
                       std::to_string(maxDepth),
                   8, 8, 1) +
        "WorldBegin\n" + kPoint +
        "\nMaterial \"matte\" Translate 0 0 4 Shape \"disk\" \"float radius\" 9\n"
        "Material \"mirror\" Translate 0 0 -6 Shape \"disk\" \"float radius\" 50\nWorldEnd\n");
  };
  EXPECT_TRUE(render(0).Says("% of the light of gather rays"));
  const std::vector<std::string> messages = render(0).messages;
  EXPECT_EQ(std::count_if(messages.begin(), messages.end(),
                          [](const std::string& message) {
                            return message.find("depth limit") != std::string::npos;
                          }),
            1)
      << "and nothing of camera rays";
  EXPECT_FALSE(render(20).Says("depth limit"));
}

TEST(PhotonEdgeCases, AnInterruptDoesNotWaitUntilAllPhotonsAreShot) {
  const std::atomic<bool> stop = true;
  TestRenderOptions options;
  options.stop = &stop;
  for (const char* integrator : {"exphotonmap", "photonmap"}) {
    const TestRender render = RenderSceneText(
        TestHeader('"' + std::string(integrator) + "\" \"integer indirectphotons\" 20000000", 4, 4,
                   1) +
            FurnaceWorld(1, "\"matte\""),
        options);
    EXPECT_FALSE(render.result.isComplete);
    EXPECT_TRUE(std::isnan(render.Counter("photons/indirect stored")));
    EXPECT_EQ(MeanRadiance(render.image), 0);
  }
}

}  // namespace
}  // namespace exphoton
