// SPDX-License-Identifier: BSD-2-Clause
// These tests check which sample arrays each integrator requests, how many rays of each kind it
// traces, and the throughput that depth limits cut, in scenes where these numbers follow.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "core/sampling/sampler.h"
#include "core/transport/integrator.h"
#include "tests/support/test_scene.h"

namespace exphoton {
namespace {

using Counts = std::vector<int>;

struct Requested {
  Counts of1D, of2D;
};

Requested RequestsOf(const std::string& integrator, const std::string& lights) {
  const LoadedScene loaded =
      LoadSceneText("Sampler \"lowdiscrepancy\"\nSurfaceIntegrator " + integrator +
                    "\nWorldBegin\n" + lights + "Shape \"sphere\"\nWorldEnd\n");
  RenderSetup& setup = *loaded.setup;
  // Requests may be made any number of times.
  Requested requested;
  for (int i = 0; i < 2; ++i) {
    SampleLayout layout;
    setup.integrator->RequestSamples(*setup.scene, *setup.sampler, &layout);
    requested = {{layout.Counts1D().begin(), layout.Counts1D().end()},
                 {layout.Counts2D().begin(), layout.Counts2D().end()}};
  }
  return requested;
}

std::string Lamp(const std::string& parameters) {
  return "AttributeBegin AreaLightSource \"area\" " + parameters +
         " Translate 0 5 0 Shape \"sphere\" AttributeEnd\n";
}

// The sampler rounds 3 to 4. A black lamp and a delta light need no samples.
const std::string kLights = "LightSource \"infinite\"\nLightSource \"point\"\n" +
                            Lamp("\"color L\" [0 0 0]") + Lamp("\"integer nsamples\" 3");

TEST(SampleRequests, OfDirectLightingAreFourForEachLight) {
  const Requested all = RequestsOf("\"directlighting\"", kLights);
  EXPECT_EQ(all.of1D, (Counts{1, 1, 4, 4}));
  EXPECT_EQ(all.of2D, (Counts{1, 1, 4, 4}));
  for (const char* strategy : {"one", "weighted", "near"}) {
    const Requested one = RequestsOf(
        std::string("\"directlighting\" \"string strategy\" \"") + strategy + "\"", kLights);
    EXPECT_EQ(one.of1D, (Counts{1, 1, 1})) << strategy;
    EXPECT_EQ(one.of2D, (Counts{1, 1})) << strategy;
  }
}

TEST(SampleRequests, OfWhittedAreOneForEachLightWithAnArea) {
  const Requested requested = RequestsOf("\"whitted\"", kLights);
  EXPECT_EQ(requested.of1D, (Counts{1, 1}));
  EXPECT_EQ(requested.of2D, (Counts{1, 1}));
}

TEST(SampleRequests, OfPathTracingAreThoseOfThreeVertices) {
  const Requested requested = RequestsOf("\"path\"", kLights);
  EXPECT_EQ(requested.of1D, Counts(9, 1));
  EXPECT_EQ(requested.of2D, Counts(6, 1));
}

// 20 lights are more than 13. The sampler rounds 13 to 16 light samples; there is one BSDF sample
// for eight of them.
TEST(SampleRequests, OfManyLightsAreOneBsdfSampleForEightLights) {
  std::string lights;
  for (int i = 0; i < 20; ++i) lights += Lamp("");
  const std::string plain =
      "\"photonmap\" \"integer finalgathersamples\" 6 \"integer directlights\" ";
  const Requested many = RequestsOf(plain + "13", lights);
  EXPECT_EQ(many.of1D, (Counts{16, 16, 2, 6, 0}));
  EXPECT_EQ(many.of2D, (Counts{16, 2, 6, 0}));
  const Requested each = RequestsOf(plain + "20", lights);
  EXPECT_EQ(each.of1D.size(), 42u);
  EXPECT_EQ(each.of2D.size(), 42u);
}

// Without directlights, each of up to 64 lights is sampled. Beyond, 16 lights are chosen.
TEST(SampleRequests, OfMoreThan64LightsAreSixteenLightSamples) {
  std::string lights;
  for (int i = 0; i < 64; ++i) lights += Lamp("");
  const std::string plain = "\"photonmap\" \"integer finalgathersamples\" 6";
  EXPECT_EQ(RequestsOf(plain, lights).of1D.size(), 130u);
  const Requested chosen = RequestsOf(plain, lights + Lamp(""));
  EXPECT_EQ(chosen.of1D, (Counts{16, 16, 2, 6, 0}));
}

// Half of 12 gather rays may follow photons, or a quarter, or an eighth. In pixels on edges, one of
// three.
TEST(SampleRequests, OfAGuidedGatherAreThoseOfEachDivision) {
  const Requested requested =
      RequestsOf("\"exphotonmap\" \"integer finalgathersamples\" 12", "LightSource \"point\"\n");
  EXPECT_EQ(requested.of1D, (Counts{6, 6, 9, 3, 11, 1, 12, 0, 2, 1, 3, 0}));
  EXPECT_EQ(requested.of2D, (Counts{6, 6, 9, 3, 11, 1, 12, 0, 2, 1, 3, 0}));
  const Requested off = RequestsOf("\"exphotonmap\" \"integer finalgathersamples\" 12", "");
  EXPECT_EQ(off.of1D, Counts(12, 0)) << "there is nothing to gather";
  const Requested direct = RequestsOf(
      "\"photonmap\" \"bool directwithphotons\" \"true\" \"integer finalgathersamples\" 12",
      kLights);
  EXPECT_EQ(direct.of1D, (Counts{12, 0})) << "no shadow rays";
}

constexpr int kRequestSide = 8, kRequestSamples = 4;
constexpr double kRequestRays = double(kRequestSide) * kRequestSide * kRequestSamples;

TestRender Render(const std::string& integrator, const std::string& world) {
  return RenderSceneText(TestHeader(integrator, kRequestSide, kRequestSide, kRequestSamples) +
                         "WorldBegin\n" + world + "WorldEnd\n");
}

double PerSample(const TestRender& render, RayKind kind) {
  return double(render.rays.counts[std::size_t(kind)]) / kRequestRays;
}

const std::string kPlane =
    "Material \"matte\" Translate 0 0 1 Shape \"disk\" \"float radius\" 99\n";

// A plane that fills the picture, under a sky and two point lights in front of it.
TEST(RaysPerSample, AreOneShadowRayForEachSampleOfALight) {
  const std::string lights =
      "LightSource \"infinite\" \"integer nsamples\" 4\nLightSource \"point\"\n"
      "LightSource \"point\" \"point from\" [1 0 0]\n";
  const TestRender direct = Render("\"directlighting\"", lights + kPlane);
  EXPECT_EQ(PerSample(direct, RayKind::Camera), 1);
  EXPECT_EQ(PerSample(direct, RayKind::Bsdf), 4);
  // Samples of the sky behind the plane need no shadow ray.
  EXPECT_GT(PerSample(direct, RayKind::Shadow), 3.5);
  EXPECT_LT(PerSample(direct, RayKind::Shadow), 4.5);
  const TestRender whitted = Render("\"whitted\"", lights + kPlane);
  EXPECT_EQ(PerSample(whitted, RayKind::Bsdf), 0);
  EXPECT_GT(PerSample(whitted, RayKind::Shadow), 2.3);
  EXPECT_LT(PerSample(whitted, RayKind::Shadow), 2.7);
}

// Direct light from the photon map, and no final gathering: there are camera rays alone.
TEST(RaysPerSample, AreOfTheCameraAloneWhereAllLightIsFromMaps) {
  const std::string settings =
      "\"photonmap\" \"integer indirectphotons\" 500 \"integer maxphotonpaths\" 2000 \"bool "
      "directwithphotons\" \"true\" \"bool "
      "finalgather\" ";
  const std::string lamp = "LightSource \"point\"\n";
  const TestRender maps = Render(settings + "\"false\"", lamp + kPlane);
  EXPECT_GT(MeanRadiance(maps.image), 0);
  for (const RayKind kind : {RayKind::Shadow, RayKind::Bsdf, RayKind::Gather})
    EXPECT_EQ(PerSample(maps, kind), 0);
  const TestRender gathers = Render(settings + "\"true\"", lamp + kPlane + kPlane);
  EXPECT_EQ(PerSample(gathers, RayKind::Shadow), 0);
  EXPECT_GT(PerSample(gathers, RayKind::Gather), 16);
}

// A white sphere ends no path early. Of the bounces after the fourth, 98 % survive.
TEST(RaysPerSample, OfPathsInAWhiteSphereEndByRoulette) {
  const auto rays = [](const std::string& kd, int depth) {
    return PerSample(
        RenderSceneText(TestHeader("\"path\" \"integer maxdepth\" " + std::to_string(depth),
                                   kRequestSide, kRequestSide, kRequestSamples) +
                        FurnaceWorld(1, "\"matte\" \"color Kd\" [" + kd + "]")),
        RayKind::Bsdf);
  };
  // The standard deviation of a mean over 256 paths is 50 / 16.
  EXPECT_NEAR(rays("1 1 1", 10000), 4 + .98 / .02, 8);
  // With albedo .1, the fifth ray survives with .1^5.
  EXPECT_NEAR(rays(".1 .1 .1", 10000), 4, .02);
  // Two bounces, and the ray to the light beyond. One path in 32 continues, so that the light
  // beyond the limit is known. The standard deviation of its share is .55.
  EXPECT_GE(rays("1 1 1", 2), 3);
  EXPECT_NEAR(rays("1 1 1", 2), 3 + (.98 / .02) / 32, 1.7);
}

// The camera looks into two parallel mirrors. A limit of d bounces cuts Kr^(d+1) of each path.
TEST(CutThroughput, IsWhatMirrorsWouldReflectBeyondTheLimit) {
  const std::string mirrors =
      "LightSource \"point\"\nMaterial \"mirror\" \"color Kr\" [.5 .5 .5]\nAttributeBegin "
      "Translate 0 0 1 "
      "Shape \"disk\" \"float radius\" 999 AttributeEnd\nTranslate 0 0 -1 Shape \"disk\" \"float "
      "radius\" 999\n";
  for (const char* integrator : {"directlighting", "whitted", "photonmap"}) {
    for (const int depth : {0, 3}) {
      const TestRender render = Render(
          "\"" + std::string(integrator) + "\" \"integer maxdepth\" " + std::to_string(depth),
          mirrors);
      EXPECT_NEAR(render.rays.cutThroughput / kRequestRays, std::pow(.5, depth + 1), 1e-6)
          << integrator;
      EXPECT_EQ(PerSample(render, RayKind::Specular), depth) << integrator;
    }
  }
}

}  // namespace
}  // namespace exphoton
