// SPDX-License-Identifier: BSD-2-Clause
// These tests check how many photons each map wants, by settings and scene, and all texts and
// counters with which the photon pass reports them.
#include "integrators/photon/photon_budget.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "core/base/error.h"
#include "core/scene/scene.h"
#include "tests/support/test_scene.h"

namespace exphoton {
namespace {

LoadedScene Load(const std::string& world) {
  return LoadSceneText("SurfaceIntegrator \"exphotonmap\"\nWorldBegin\n" + world + "\nWorldEnd\n");
}

const std::string kBudgetLamp = "LightSource \"point\" \"point from\" [0 0 2]\n";
const std::string kMatte = "Material \"matte\" Shape \"sphere\" \"float radius\" 3\n";
const std::string kGlass = "Material \"glass\" Shape \"sphere\"\n";

PhotonSettings Numbers() {
  PhotonSettings settings;
  settings.causticPhotons = 10;
  settings.directPhotons = 20;
  settings.indirectPhotons = 30;
  return settings;
}

std::string TargetsOf(const PhotonSettings& settings, const LoadedScene& scene) {
  return TextOf(ChooseTargets(settings, *scene.setup->scene));
}

TEST(PhotonTargets, AreThoseOfTheSettings) {
  const LoadedScene scene = Load(kBudgetLamp + kMatte + kGlass);
  PhotonSettings settings = Numbers();
  EXPECT_EQ(TargetsOf(settings, scene), "20 direct, 10 caustic, 30 indirect");
  EXPECT_EQ(ChooseTargets(settings, *scene.setup->scene).Least(), 10);
  settings.directPhotons.reset();
  EXPECT_EQ(TargetsOf(settings, scene), "30 direct, 10 caustic, 30 indirect");
  settings.causticPhotons.reset();
  EXPECT_EQ(TargetsOf(settings, scene), "30 direct, 20000 caustic, 30 indirect");
  settings.indirectPhotons = 0;
  settings.causticPhotons = 0;
  EXPECT_EQ(TargetsOf(settings, scene), "100000 direct") << "gather rays read direct light";
  settings.directPhotons = 0;
  EXPECT_EQ(TargetsOf(settings, scene), "");
  EXPECT_EQ(ChooseTargets(settings, *scene.setup->scene).Least(), 0);
}

TEST(PhotonTargets, LeaveOutWhatTheSceneDoesNotNeed) {
  const PhotonSettings settings = Numbers();
  EXPECT_EQ(TargetsOf(settings, Load(kBudgetLamp + kMatte)), "20 direct, 30 indirect");
  EXPECT_EQ(TargetsOf(settings, Load(kBudgetLamp + kGlass)), "");
  EXPECT_EQ(TargetsOf(settings, Load(kMatte + kGlass)), "");
}

// Without final gathering, the direct map is of use only where direct light is read from it.
TEST(PhotonTargets, HaveADirectMapToGatherFromOrToSee) {
  const LoadedScene scene = Load(kBudgetLamp + kMatte + kGlass);
  PhotonSettings settings = Numbers();
  settings.finalGather = false;
  EXPECT_EQ(TargetsOf(settings, scene), "10 caustic, 30 indirect");
  EXPECT_FALSE(GathersIndirectLight(settings, *scene.setup->scene));
  settings.directWithPhotons = true;
  EXPECT_EQ(TargetsOf(settings, scene), "20 direct, 10 caustic, 30 indirect");
  settings.finalGather = true;
  EXPECT_TRUE(GathersIndirectLight(settings, *scene.setup->scene));
}

TEST(PhotonTargets, OfAShownMapAreThatMapsAlone) {
  const LoadedScene scene = Load(kBudgetLamp + kMatte + kGlass);
  PhotonSettings settings = Numbers();
  settings.directWithPhotons = true;
  const auto shown = [&](ShowMap show) {
    settings.show = show;
    EXPECT_FALSE(GathersIndirectLight(settings, *scene.setup->scene));
    return TargetsOf(settings, scene);
  };
  EXPECT_EQ(shown(ShowMap::Direct), "20 direct");
  EXPECT_EQ(shown(ShowMap::Caustic), "10 caustic");
  EXPECT_EQ(shown(ShowMap::Indirect), "30 indirect");
  EXPECT_EQ(shown(ShowMap::Radiance), "20 direct, 10 caustic, 30 indirect");
}

TEST(PhotonTargets, HaveRadiancePhotonsToGatherFromOrToSee) {
  const LoadedScene scene = Load(kBudgetLamp + kMatte);
  PhotonSettings settings = Numbers();
  settings.radianceFraction = Real(.5);
  const auto fraction = [&] {
    return ChooseTargets(settings, *scene.setup->scene).radianceFraction;
  };
  EXPECT_EQ(fraction(), 0);
  settings.radiancePhotons = true;
  EXPECT_EQ(fraction(), Real(.5));
  settings.finalGather = false;
  EXPECT_EQ(fraction(), 0);
  settings.show = ShowMap::Radiance;
  EXPECT_EQ(fraction(), Real(.5));
  settings.show = ShowMap::Direct;
  EXPECT_EQ(fraction(), 0);
}

TEST(PhotonBudget, IsExplainedInFiveLines) {
  const LoadedScene scene = Load(kBudgetLamp + kMatte);
  PhotonSettings settings = Numbers();
  const auto lines = [&] { return ExplainBudget(settings, *scene.setup->scene); };
  EXPECT_EQ(lines(), (std::vector<std::string>{
                         "photons       20 direct, 30 indirect", "gather        32 rays, BSDF only",
                         "memory        about 1 MiB for the photon maps",
                         "emission      not guided (guideemission false)",
                         "walls         hide no photons: hidephotons is off"}));
  settings.hidePhotons = true;
  EXPECT_EQ(lines()[4], "walls         hide photons from points behind them");
  settings.guideEmission = true;
  EXPECT_EQ(lines()[3], "emission      guided for indirect photons, if few paths leave any");
  settings.photonRoulette = PhotonRoulette::Constant;
  EXPECT_EQ(lines()[3], "emission      not guided (photonroulette \"constant\")");
  settings.gatherSampling = GatherSampling::Photons;
  settings.finalGatherSamples = 7;
  EXPECT_EQ(lines()[1], "gather        7 rays, up to half of them round photons' directions");
  settings.indirectPhotons = 0;
  EXPECT_EQ(lines()[1], "gather        7 rays, BSDF only (0 indirect photons)");
  settings.finalGather = false;
  EXPECT_EQ(lines()[1], "gather        off");
  EXPECT_EQ(lines()[0], "photons       none");
}

// Media emit some of the indirect photons, and a guide covers lights alone.
TEST(PhotonBudget, ExplainsThatPhotonsOfMediaAreNotGuided) {
  PhotonSettings settings = Numbers();
  settings.guideEmission = true;
  const auto emission = [&](const std::string& world) {
    return ExplainBudget(settings, *Load(kBudgetLamp + kMatte + world).setup->scene)[3];
  };
  const std::string glow = "Volume \"homogeneous\" \"color Le\" [1 1 1]\n";
  EXPECT_EQ(emission(glow), "emission      not guided (a medium emits photons)");
  EXPECT_EQ(emission(glow + kGlass),
            "emission      guided for caustic photons, if few paths leave any");
  EXPECT_EQ(emission("Volume \"homogeneous\" \"color sigma_s\" [1 1 1]\n"),
            "emission      guided for indirect photons, if few paths leave any");
}

// A photon takes about 32 bytes, so a million of them take about 31 MiB; twice that in double.
TEST(PhotonBudget, CountsTheBytesOfPhotonsAndRadiancePhotons) {
  PhotonTargets targets;
  EXPECT_EQ(BytesOf(targets), 0);
  targets[PhotonKind::Direct] = 1000000;
  const double one = BytesOf(targets);
  EXPECT_GT(one, 27e6 * sizeof(Real) / 4);
  EXPECT_LE(one, 32e6 * sizeof(Real) / 4);
  targets[PhotonKind::Caustic] = targets[PhotonKind::Indirect] = 1000000;
  EXPECT_DOUBLE_EQ(BytesOf(targets), 3 * one);
  targets.radianceFraction = Real(.5);
  const double half = BytesOf(targets) - 3 * one;
  targets.radianceFraction = 1;
  EXPECT_DOUBLE_EQ(BytesOf(targets) - 3 * one, 2 * half);
  EXPECT_GT(half, 1.5e6 * 28);
  try {
    FailByMemory(targets);
  } catch (const Error& error) {
    EXPECT_EQ(error.Status(), ExitStatus::Resource);
    EXPECT_EQ(
        std::string(error.what())
            .rfind("photon maps of 1000000 direct, 1000000 caustic, 1000000 indirect photons take ",
                   0),
        0u)
        << error.what();
  }
}

TestRender Render(const std::string& settings, const std::string& world) {
  return RenderSceneText(TestHeader(settings, 2, 2, 1) + "WorldBegin\n" + world + "\nWorldEnd\n");
}

const std::string kSphere = "ReverseOrientation Shape \"sphere\" \"float radius\" 5\n";

// Every path in a closed sphere stores one direct photon.
TEST(PhotonReport, HasACounterForAllThatIsStored) {
  const TestRender render = Render(
      "\"exphotonmap\" \"integer directphotons\" 300 \"integer indirectphotons\" 200 "
      "\"integer causticphotons\" 100 \"float maxdist\" 1.5 \"integer maxphotonpaths\" 4096",
      "LightSource \"point\" \"point from\" [0 0 3]\nMaterial \"matte\"\n" + kSphere + kGlass);
  double bytes = 0;
  for (const std::string map : {"direct", "caustic", "indirect"}) {
    EXPECT_GE(render.Counter("photons/" + map + " stored"), 100) << map;
    EXPECT_GE(render.Counter("photons/" + map + " paths"), 64) << map;
    EXPECT_LE(render.Counter("photons/" + map + " paths"), render.Counter("photons/shot")) << map;
    EXPECT_EQ(render.Counter("photons/" + map + " maxdist"), 1.5) << map;
    bytes += 24 * render.Counter("photons/" + map + " stored");
  }
  EXPECT_GT(render.Counter("photons/radiance photons"), 10);
  EXPECT_GT(render.Counter("photons/memory"), bytes);
  EXPECT_NEAR(render.Counter("photons/emitted power"), 4 * 3.14159265, 1e-3);
  EXPECT_GT(render.Counter("photons/shot"), 0);
  EXPECT_TRUE(std::isnan(render.Counter("photons/non-finite")));
  EXPECT_FALSE(render.Says("maxdist chosen"));
  EXPECT_FALSE(render.Says(" map: "));
  for (const Statistics::Counter& counter : render.counters)
    EXPECT_FALSE(counter.meaning.empty()) << counter.name;
}

TEST(PhotonReport, NamesTheRadiiThatItChose) {
  const TestRender render =
      Render("\"photonmap\" \"integer indirectphotons\" 200 \"integer causticphotons\" 0",
             kBudgetLamp + "Material \"matte\"\n" + kSphere);
  EXPECT_TRUE(render.Says("maxdist chosen from the photons: direct "));
  EXPECT_TRUE(render.Says(", indirect "));
  EXPECT_TRUE(std::isnan(render.Counter("photons/radiance photons")));
}

TEST(PhotonReport, SaysHowFarAMapWasFilled) {
  const TestRender render = Render(
      "\"photonmap\" \"integer indirectphotons\" 0 \"integer directphotons\" 5000 \"integer "
      "causticphotons\" 0 \"integer maxphotonpaths\" 100",
      kBudgetLamp + "Material \"matte\"\n" + kSphere);
  EXPECT_TRUE(render.Says("direct map: 192 of 5000 photons after 192 paths"));
}

// Caustic photons alone: paths that pass the glass by are counted, but not traced.
TEST(PhotonReport, CountsPathsThatPassGlassBy) {
  const TestRender render = Render(
      "\"photonmap\" \"integer indirectphotons\" 0 \"integer directphotons\" 0 \"integer "
      "causticphotons\" 300",
      "LightSource \"point\" \"point from\" [0 0 3]\nMaterial \"matte\"\n" + kSphere + kGlass);
  const double share = render.Counter("photons/skipped") / render.Counter("photons/shot");
  // The glass sphere of radius 1 is seen at a distance of 3, and so is its box.
  EXPECT_GT(share, .85);
  EXPECT_LT(share, 1 - (1 - std::sqrt(8.) / 3) / 2);
}

// The warning names the share that is cut in percent: here .5^8, which is .4 %, and some noise.
TEST(PhotonReport, WarnsOfTheShareThatTheDepthLimitCuts) {
  const auto says = [](const std::string& kd, int depth) {
    return Render(
        "\"photonmap\" \"string photonroulette\" \"luminance\" \"integer "
        "indirectphotons\" 2000 \"integer maxphotonpaths\" 4000 \"integer maxphotondepth\" " +
            std::to_string(depth),
        kBudgetLamp + "Material \"matte\" \"color Kd\" [" + kd + "]\n" + kSphere);
  };
  // .5^11 is less than a thousandth, .5^9 is more.
  EXPECT_FALSE(says(".5 .5 .5", 11).Says("maxphotondepth"));
  const TestRender render = says(".5 .5 .5", 8);
  EXPECT_TRUE(render.Says("maxphotondepth 8 cut 0."));
  EXPECT_FALSE(render.Says("cut 0.0"));
  EXPECT_TRUE(render.Says(" % of the emitted power"));
}

TEST(PhotonReport, NamesAtMostFiveLightsThatStoreNothing) {
  std::string lights;
  for (int i = 0; i < 7; ++i)
    lights += "LightSource \"spot\" \"point from\" [0 0 9] \"point to\" [0 0 10]\n";
  const TestRender render = Render(
      "\"photonmap\" \"integer indirectphotons\" 0 \"integer directphotons\" 2000 \"integer "
      "causticphotons\" 0",
      lights + kBudgetLamp + "Material \"matte\"\n" + kMatte);
  EXPECT_TRUE(render.Says("light 5 (spot) has shot "));
  EXPECT_FALSE(render.Says("light 6 (spot)"));
  EXPECT_TRUE(render.Says("2 more lights shot photons and none was stored"));
}

}  // namespace
}  // namespace exphoton
