// SPDX-License-Identifier: BSD-2-Clause
// These tests compare "ambientocclusion" and "debug" with closed forms.
#include <gtest/gtest.h>

#include "tests/support/equivalence.h"
#include "tests/support/test_scene.h"

namespace exphoton {
namespace {

// The camera looks down on a spot of the floor z = 0 at the origin.
std::string Floor(const std::string& integrator, const std::string& world) {
  return "SurfaceIntegrator " + integrator +
         R"(
Film "image" "integer xresolution" [4] "integer yresolution" [4]
PixelFilter "box"
LookAt 0 -.3 1  0 0 0  0 1 0
Camera "perspective" "float fov" [.05]
Sampler "lowdiscrepancy" "integer pixelsamples" [4]
WorldBegin
Shape "trianglemesh" "integer indices" [0 1 2 0 2 3]
  "point P" [-9 -9 0  9 -9 0  9 9 0  -9 9 0] "float uv" [0 0 1 0 1 1 0 1]
)" + world +
         "\nWorldEnd\n";
}

SeedEstimate Openness(const std::string& parameters, const std::string& world) {
  return EstimateOverSeeds([&](std::uint64_t seed) {
    TestRenderOptions options;
    options.seed = seed;
    return MeanRadiance(
        RenderSceneText(Floor("\"ambientocclusion\" " + parameters, world), options).image);
  });
}

const std::string kDisk =
    "Translate 0 0 2\nShape \"disk\" \"float radius\" 1.5\n";  // at half-angle atan(.75)

TEST(AmbientOcclusion, OfAnOpenFloorIsOne) {
  EXPECT_EQ(Openness("\"integer nsamples\" 16", "").mean, 1);
}

// The disk covers the directions with cos >= .8: a share of .2 uniformly and of .36 by the cosine.
TEST(AmbientOcclusion, UnderADiskIsTheClosedForm) {
  EXPECT_TRUE(IsWithin(.005, Openness("\"integer nsamples\" 512", kDisk), .8));
  EXPECT_TRUE(IsWithin(
      .005, Openness("\"integer nsamples\" 512 \"string weighting\" \"cosine\"", kDisk), .64));
}

TEST(AmbientOcclusion, CountsSurfacesBetweenMindistAndMaxdistAlone) {
  const std::string rays = "\"integer nsamples\" 64 ";
  EXPECT_EQ(Openness(rays + "\"float maxdist\" 1.9", kDisk).mean, 1);
  EXPECT_LT(Openness(rays + "\"float maxdist\" 2.2", kDisk).mean, 1);
  EXPECT_EQ(Openness(rays + "\"float mindist\" 2.6", kDisk).mean, 1);
  EXPECT_LT(Openness(rays + "\"float mindist\" 1.9", kDisk).mean, 1);
  // From 1.9 on, the interval ends at maxdist and not beyond it.
  EXPECT_EQ(Openness(rays + "\"float mindist\" 1 \"float maxdist\" 1.9", kDisk).mean, 1);
}

TEST(AmbientOcclusion, TakesTwoThousandRaysUniformlyByDefault) {
  const TestRender render = RenderSceneText(Floor("\"ambientocclusion\"", kDisk));
  EXPECT_EQ(render.rays.counts[std::size_t(RayKind::Shadow)], 2048u * 4 * 16);
  EXPECT_NEAR(MeanRadiance(render.image), .8, .002);
}

TEST(AmbientOcclusion, ShowsTheSkyBehindTheScene) {
  const auto render =
      RenderSceneText(TestHeader("\"ambientocclusion\"", 2, 2, 1) +
                      "WorldBegin\nLightSource \"infinite\" \"color L\" [3 3 3]\nWorldEnd\n");
  EXPECT_EQ(MeanRadiance(render.image), 3);
}

double Channel(const std::string& parameters, const std::string& channel,
               const std::string& world = "") {
  return MeanChannel(RenderSceneText(Floor("\"debug\" " + parameters, world)).image, channel);
}

TEST(Debug, ShowsParametricCoordinatesByDefault) {
  const std::string shifted =
      "Shape \"trianglemesh\" \"integer indices\" [0 1 2] \"point P\" [-1 -1 "
      ".1  1 -1 .1  0 1 .1] \"float uv\" [.25 .5 .25 .5 .25 .5]\n";
  EXPECT_NEAR(Channel("", "R", shifted), .25, 1e-6);
  EXPECT_NEAR(Channel("", "G", shifted), .5, 1e-6);
  EXPECT_EQ(Channel("", "B", shifted), 0);
  EXPECT_NEAR(Channel("\"string blue\" \"u\" \"string red\" \"zero\"", "B", shifted), .25, 1e-6);
  EXPECT_EQ(Channel("\"string blue\" \"u\" \"string red\" \"zero\"", "R", shifted), 0);
}

TEST(Debug, ShowsNormalsPositionsAndDistances) {
  EXPECT_NEAR(Channel("\"string green\" \"one\"", "G"), 1, 0);
  EXPECT_NEAR(Channel("\"string red\" \"nz\"", "R"), 1, 1e-6);
  EXPECT_NEAR(Channel("\"string red\" \"nx\"", "R"), .5, 1e-6);
  EXPECT_NEAR(Channel("\"string red\" \"ngz\" \"string green\" \"ngy\"", "R"), 1, 1e-6);
  EXPECT_NEAR(Channel("\"string red\" \"ngz\" \"string green\" \"ngy\"", "G"), .5, 1e-6);
  EXPECT_NEAR(Channel("\"string blue\" \"distance\"", "B"), std::sqrt(1.09), 1e-3);
  EXPECT_NEAR(Channel("\"string blue\" \"facing\"", "B"), 1 / std::sqrt(1.09), 1e-3);
  EXPECT_NEAR(Channel("\"string blue\" \"z\"", "B",
                      "Translate 0 0 .25\nShape \"disk\" \"float radius\" 2\n"),
              .25, 1e-5);
}

// (.6, 0, .8) times the direction to the camera, (0, -.3, 1) / sqrt(1.09).
TEST(Debug, FacingIsThatOfTheShadingNormal) {
  const std::string leaning =
      "Shape \"trianglemesh\" \"integer indices\" [0 1 2] \"point P\" [-1 -1 .1  1 -1 .1  0 1 .1] "
      "\"normal N\" [.6 0 .8  .6 0 .8  .6 0 .8]\n";
  EXPECT_NEAR(Channel("\"string blue\" \"facing\"", "B", leaning), .8 / std::sqrt(1.09), 1e-3);
}

TEST(Debug, IsTransparentBesideTheScene) {
  const auto render = RenderSceneText(TestHeader("\"debug\"", 2, 2, 1) + "WorldBegin\nWorldEnd\n");
  EXPECT_EQ(MeanChannel(render.image, "A"), 0);
}

}  // namespace
}  // namespace exphoton
