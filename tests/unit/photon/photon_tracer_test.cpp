// SPDX-License-Identifier: BSD-2-Clause
// These tests check the photons that the photon tracer stores: the side of the surface for radiance
// photons, the rule for caustic photons, and different photons for different seeds.
#include "integrators/photon/shooting/photon_tracer.h"

#include <gtest/gtest.h>

#include "core/imaging/film/film.h"
#include "core/render/passes/render_halves.h"
#include "tests/support/photon_shots.h"
#include "tests/support/test_scene.h"

namespace exphoton {
namespace {

// The scene is a sphere around a lamp, with normals outwards or inwards.
TEST(PhotonTracer, GivesRadiancePhotonsTheNormalOnTheSideOfTheLight) {
  for (const std::string orientation : {"", "ReverseOrientation "}) {
    const LoadedScene loaded = LoadSceneText("WorldBegin\nLightSource \"point\"\n" + orientation +
                                             "Shape \"sphere\" \"float radius\" 2\nWorldEnd\n");
    PhotonTargets targets;
    targets[PhotonKind::Direct] = targets[PhotonKind::Indirect] = 2000;
    targets.radianceFraction = Real(.5);
    PhotonPassResult result = ShootPhotons(*loaded.setup->scene, 1, targets);
    const auto seeds = result.sites.Records();
    ASSERT_GT(seeds.size(), 500u);
    for (const RadiancePhotonSite& seed : seeds)
      ASSERT_NEAR(Dot(seed.n, seed.p - Point3()), -2, 1e-3) << orientation;
  }
}

// The scene is a spot light over a matte floor, with a mirror behind the light. If the light points
// down, photons from the mirror have met the floor before.
TEST(PhotonTracer, StoresNoCausticPhotonAfterADiffuseBounce) {
  const auto shoot = [](const std::string& light) {
    const LoadedScene loaded =
        LoadSceneText("WorldBegin\n" + light +
                      "\nShape \"disk\" \"float radius\" 9\nMaterial \"mirror\"\nTranslate 0 0 4\n"
                      "ReverseOrientation Shape \"disk\" \"float radius\" 9\nWorldEnd\n");
    PhotonTargets targets;
    targets[PhotonKind::Caustic] = targets[PhotonKind::Indirect] = 500;
    return ShootPhotons(*loaded.setup->scene, 1, targets);
  };
  const std::string at = R"( "point from" [0 0 2] "point to" [0 0 )";
  PhotonPassResult down = shoot(R"(LightSource "spot")" + at + "0]");
  EXPECT_EQ(down[PhotonKind::Caustic].photons.Size(), 0u);
  EXPECT_GE(down[PhotonKind::Indirect].photons.Size(), 500u);
  PhotonPassResult up = shoot(R"(LightSource "spot")" + at + "4]");
  EXPECT_GE(up[PhotonKind::Caustic].photons.Size(), 500u);
}

const char* const kTracerFloor =
    "WorldBegin\nLightSource \"point\" \"point from\" [0 0 1]\nMaterial \"matte\" \"color Kd\" "
    "[.5 .5 .5]\nTranslate 0 0 3 Shape \"disk\" \"float radius\" 9\nTranslate 0 0 -6 "
    "Shape \"disk\" \"float radius\" 9\nWorldEnd\n";
const char* const kIntegrator =
    " \"integer indirectphotons\" 2000 \"integer directphotons\" 2000 \"bool finalgather\" "
    "\"false\" \"string show\" \"directphotons\" \"float maxdist\" .2";

// The direct map is full long before the indirect map. Its path count must contain only the paths
// up to that time.
TEST(PhotonReport, CountsThePathsOfEachMap) {
  LoadedScene loaded = LoadSceneText(
      TestHeader("\"photonmap\" \"bool directwithphotons\" \"true\" \"integer directphotons\" 100 "
                 "\"integer indirectphotons\" 20000 \"bool finalgather\" \"false\"",
                 2, 2, 1) +
      kTracerFloor);
  const TestRender render = RenderLoaded(loaded);
  EXPECT_EQ(render.Counter("photons/indirect paths"), render.Counter("photons/shot"));
  EXPECT_GE(render.Counter("photons/direct stored"), 100);
  EXPECT_LT(render.Counter("photons/direct paths"), .1 * render.Counter("photons/shot"));
}

class PhotonSeeds : public testing::TestWithParam<const char*> {};

TEST_P(PhotonSeeds, ShootOtherPhotons) {
  const std::string scene =
      TestHeader(std::string("\"") + GetParam() + "\"" + kIntegrator, 8, 8, 1) + kTracerFloor;
  const auto photons = [&](std::uint64_t seed) {
    LoadedScene loaded = LoadSceneText(scene);
    TestRenderOptions options;
    options.seed = seed;
    RenderLoaded(loaded, options);
    const SurfaceIntegrator& integrator = *loaded.setup->integrator;
    EXPECT_EQ(integrator.PhotonMapNames().at(1), "direct");
    return integrator.PhotonsNear({0, 0, 3}, 1, 30);
  };
  const auto one = photons(1), again = photons(1), two = photons(2);
  ASSERT_EQ(one.size(), 30u);
  for (std::size_t i = 0; i < one.size(); ++i) {
    EXPECT_EQ(one[i].p, again[i].p);
    ASSERT_NE(one[i].p, two[i].p);
  }
}

// Each half has separate photon maps, so the difference between the halves does not fall with the
// number of camera samples.
TEST_P(PhotonSeeds, MakeTheNoiseOfTwoHalvesThatOfMaps) {
  const auto noise = [](int samples) {
    LoadedScene loaded = LoadSceneText(
        TestHeader(std::string("\"") + GetParam() + "\"" + kIntegrator, 16, 16, samples) +
        kTracerFloor);
    RenderSetup& setup = *loaded.setup;
    Film film(setup.film.Full(), setup.crop), first = film, second = film;
    ThreadPool threads(1);
    ProgressReporter progress(ProgressReporter::Mode::Quiet);
    Statistics statistics;
    return *RenderTwoHalves({*setup.scene, *setup.integrator, *setup.sampler, *setup.filter,
                             *setup.camera, film, threads, *loaded.log, progress, statistics},
                            {}, &first, &second)
                .noise;
  };
  const double ofFew = noise(16);
  EXPECT_GT(ofFew, 0);
  EXPECT_GT(noise(256), .25 * ofFew);  // noise of camera samples alone would fall to 1/16
}

INSTANTIATE_TEST_SUITE_P(Integrators, PhotonSeeds, testing::Values("photonmap", "exphotonmap"));

}  // namespace
}  // namespace exphoton
