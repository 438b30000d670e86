// SPDX-License-Identifier: BSD-2-Clause
// These tests compare direct lighting and path tracing with closed forms: planes under each kind of
// light, furnaces, and split, black and hidden lights. They use the equivalence rule over 8 seeds
// (tests/support/equivalence.h). Each test derives its expected value.
#include <gtest/gtest.h>

#include <string>

#include "tests/support/equivalence.h"
#include "tests/support/test_scene.h"

namespace exphoton {
namespace {

constexpr double kAlbedo = .5;

SeedEstimate Mean(const std::string& scene) {
  return EstimateOverSeeds([&](std::uint64_t seed) {
    TestRenderOptions options;
    options.seed = seed;
    return MeanRadiance(RenderSceneText(scene, options).image);
  });
}

// Returns a scene with the lights, in which the camera at (0, -.3, 1) sees a tiny spot of a matte
// floor at the origin. The floor is the plane z = 0 with the normal +z.
std::string FloorUnder(const std::string& integrator, const std::string& lights, int samples) {
  return "SurfaceIntegrator " + integrator + R"(
Film "image" "integer xresolution" [4] "integer yresolution" [4]
PixelFilter "box"
LookAt 0 -.3 1  0 0 0  0 1 0
Camera "perspective" "float fov" [.05]
Sampler "lowdiscrepancy" "integer pixelsamples" [)" +
         std::to_string(samples) + R"(]
WorldBegin
)" + lights +
         R"(
Material "matte" "color Kd" [.5 .5 .5]
Shape "trianglemesh" "integer indices" [0 1 2 0 2 3]
  "point P" [-9 -9 0  9 -9 0  9 9 0  -9 9 0]
WorldEnd
)";
}

class FloorLight : public testing::TestWithParam<const char*> {
 protected:
  // Depth 0 removes the light that lamps reflect, because the closed forms do not include it.
  static std::string Integrator() {
    return "\"" + std::string(GetParam()) + "\" \"integer maxdepth\" 0";
  }
  // Returns the irradiance that the picture of the floor shows.
  SeedEstimate Irradiance(const std::string& lights, int samples) const {
    const SeedEstimate estimate = Mean(FloorUnder(Integrator(), lights, samples));
    const double factor = M_PI / kAlbedo;
    return {estimate.mean * factor, estimate.standardDeviation * factor,
            estimate.halfWidth * factor};
  }
};

TEST_P(FloorLight, OfAPointIsIntensityTimesCosineOverDistanceSquared) {
  const auto estimate =
      Irradiance(R"(LightSource "point" "color I" [5 5 5] "point from" [3 0 4])", 1);
  EXPECT_TRUE(IsWithin(.001, estimate, 5.0 * .8 / 25));
}

TEST_P(FloorLight, OfTheSunIsRadianceTimesCosine) {
  const auto estimate = Irradiance(
      R"(LightSource "distant" "color L" [2 2 2] "point from" [3 0 4] "point to" [0 0 0])", 1);
  EXPECT_TRUE(IsWithin(.001, estimate, 2.0 * .8));
}

TEST_P(FloorLight, OfAUniformSkyIsPiTimesRadiance) {
  const auto estimate = Irradiance(R"(LightSource "infinite" "color L" [3 3 3])", 512);
  EXPECT_TRUE(IsWithin(.005, estimate, 3 * M_PI));
}

// Under the centre of a disk, the irradiance is E = pi L r^2 / (r^2 + h^2).
TEST_P(FloorLight, OfADiskAboveIsTheClosedForm) {
  const auto estimate = Irradiance(R"(AttributeBegin
Translate 0 0 2
ReverseOrientation
AreaLightSource "area" "color L" [7 7 7]
Shape "disk" "float radius" 1.5
AttributeEnd)",
                                   512);
  EXPECT_TRUE(IsWithin(.005, estimate, M_PI * 7 * 2.25 / (2.25 + 4)));
}

// Under a sphere wholly above the horizon, the irradiance is E = pi L (r/d)^2 cos.
TEST_P(FloorLight, OfASphereIsTheClosedForm) {
  const auto estimate = Irradiance(R"(AttributeBegin
Translate 3 0 4
AreaLightSource "area" "color L" [7 7 7]
Shape "sphere" "float radius" 1
AttributeEnd)",
                                   256);
  EXPECT_TRUE(IsWithin(.002, estimate, M_PI * 7 * (1.0 / 25) * .8));
}

// Lambert's formula: E = L/2 sum over edges of angle times the z of the edge's unit normal.
template <std::size_t kCorners>
double PolygonIrradiance(const double (&v)[kCorners][3], double radiance) {
  double irradiance = 0;
  for (std::size_t i = 0; i < kCorners; ++i) {
    const double *a = v[i], *b = v[(i + 1) % kCorners];
    const double cross[3] = {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2],
                             a[0] * b[1] - a[1] * b[0]};
    const double length = std::hypot(cross[0], cross[1], cross[2]);
    const double dot = a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    irradiance += radiance / 2 * std::atan2(length, dot) * cross[2] / length;
  }
  return std::abs(irradiance);
}

TEST_P(FloorLight, OfATriangleIsLambertsFormula) {
  const double v[3][3] = {{-1, -.5, 2}, {2, 0, 1.5}, {.5, 1.5, 3}};
  const auto estimate = Irradiance(R"(AttributeBegin
AreaLightSource "area" "color L" [3 3 3]
Shape "trianglemesh" "integer indices" [0 2 1] "point P" [-1 -.5 2  2 0 1.5  .5 1.5 3]
AttributeEnd)",
                                   1024);
  EXPECT_TRUE(IsWithin(.005, estimate, PolygonIrradiance(v, 3)));
}

// Two lamps of two triangles each: which lamp is sampled must not say which of its triangles.
TEST_P(FloorLight, OfTwoLampsOfTwoTrianglesIsTheirSum) {
  const double left[4][3] = {{-2, -1, 1}, {-2, 2, 1}, {-1, 2, 2}, {-1, -1, 2}};
  const double right[4][3] = {{1, 0, 2}, {4, 0, 2}, {4, 1, 2}, {1, 1, 2}};
  const auto estimate = Irradiance(R"(AttributeBegin
AreaLightSource "area" "color L" [3 3 3]
Shape "trianglemesh" "integer indices" [0 1 2 0 2 3] "point P" [-2 -1 1 -2 2 1 -1 2 2 -1 -1 2]
Shape "trianglemesh" "integer indices" [0 2 1 0 3 2] "point P" [1 0 2 4 0 2 4 1 2 1 1 2]
AttributeEnd)",
                                   1024);
  EXPECT_TRUE(IsWithin(.005, estimate, PolygonIrradiance(left, 3) + PolygonIrradiance(right, 3)));
}

// "nsamples" 3 is rounded up to a power of two by this sampler: to the last bit the same as 4.
// Neither light samples nor BSDF samples see the sky through a wall.
TEST(DirectLighting, OfTheSkyIsNoneWithinAClosedRoom) {
  for (const char* integrator : {"\"directlighting\"", "\"path\""})
    EXPECT_EQ(MeanRadiance(RenderSceneText(TestHeader(integrator, 8, 8, 8) +
                                           "WorldBegin LightSource \"infinite\"\nMaterial "
                                           "\"matte\" Shape \"sphere\"\nWorldEnd\n")
                               .image),
              0)
        << integrator;
}

TEST(DirectLighting, OfARoundedNumberOfSamplesIsTheirMean) {
  const auto pixels = [](const std::string& count) {
    return RenderSceneText(
               FloorUnder("\"directlighting\"",
                          "AttributeBegin AreaLightSource \"area\" \"color L\" [3 3 3] \"integer "
                          "nsamples\" " +
                              count +
                              " Translate 0 0 2 ReverseOrientation Shape \"disk\" AttributeEnd",
                          4))
        .image.pixels;
  };
  EXPECT_GT(pixels("4")[0], 0);
  EXPECT_EQ(pixels("3"), pixels("4"));
}

TEST_P(FloorLight, BehindTheFloorOrEdgeOnIsExactlyNone) {
  for (const char* light : {R"(LightSource "point" "point from" [0 0 -2])",
                            R"(LightSource "distant" "point from" [0 0 -1] "point to" [0 0 0])",
                            R"(LightSource "distant" "point from" [1 0 0] "point to" [0 0 0])",
                            R"(LightSource "spot" "point from" [0 0 2] "point to" [0 0 4])",
                            R"(AreaLightSource "area" Shape "trianglemesh" "integer indices" [0 1 2]
           "point P" [-1 -1 -2  1 -1 -2  0 1 -2] AreaLightSource "area" "color L" [0 0 0])"}) {
    EXPECT_EQ(Irradiance(light, 4).mean, 0) << light;
  }
}

TEST_P(FloorLight, SplitIntoManyIsTheSameLight) {
  for (const int count : {2, 7}) {
    std::string lights;
    for (int i = 0; i < count; ++i) {
      const std::string share = std::to_string(5.0 / count);
      lights += "LightSource \"point\" \"point from\" [3 0 4] \"color I\" [" + share + " " + share +
                " " + share + "]\n";
    }
    EXPECT_TRUE(IsWithin(.002, Irradiance(lights, 64), 5.0 * .8 / 25));
  }
}

TEST_P(FloorLight, NextToABlackLightGivesTheSamePictureBitForBit) {
  const std::string black = R"(LightSource "point" "color I" [0 0 0]
LightSource "infinite" "color L" [0 0 0]
)";
  const std::string white = R"(AttributeBegin
Translate 3 0 4
AreaLightSource "area" "color L" [7 7 7]
Shape "sphere" "float radius" 1
AttributeEnd
)";
  const auto with = RenderSceneText(FloorUnder(Integrator(), black + white, 8));
  const auto without = RenderSceneText(FloorUnder(Integrator(), white, 8));
  EXPECT_EQ(with.image.pixels, without.image.pixels);
  EXPECT_GT(MeanRadiance(with.image), 0);
}

INSTANTIATE_TEST_SUITE_P(Integrators, FloorLight,
                         testing::Values("whitted", "directlighting", "path", "bidirectional"),
                         [](const auto& info) { return std::string(info.param); });

// All three strategies for choosing lights must have the same mean.
TEST(DirectLightingStrategies, HaveTheSameMean) {
  const std::string lights = R"(LightSource "point" "color I" [5 5 5] "point from" [3 0 4]
LightSource "infinite" "color L" [.1 .1 .1]
)";
  const double truth = kAlbedo / M_PI * (5.0 * .8 / 25 + .1 * M_PI);
  for (const char* strategy : {"all", "one", "weighted"}) {
    const std::string integrator =
        "\"directlighting\" \"string strategy\" \"" + std::string(strategy) + "\"";
    EXPECT_TRUE(IsWithin(.005, Mean(FloorUnder(integrator, lights, 1024)), truth)) << strategy;
  }
}

// A closed sphere with emission e and reflectance a shows e / (1 - a) everywhere. With a depth
// limit, the radiance is the sum of e a^i for i up to depth + 1, because light is collected at
// depth + 1 surfaces.
TEST(PathFurnace, ShowsEmissionOverOneMinusAlbedo) {
  for (const double albedo : {.5, .8, .9}) {
    const std::string a = std::to_string(albedo);
    const std::string scene =
        TestHeader("\"path\" \"integer maxdepth\" [1000]", 8, 8, albedo > .7 ? 256 : 64) +
        FurnaceWorld(1, "\"matte\" \"color Kd\" [" + a + " " + a + " " + a + "]");
    EXPECT_TRUE(IsWithin(.01, Mean(scene), 1 / (1 - albedo))) << albedo;
  }
}

TEST(PathFurnace, OfALimitedDepthShowsAPartialSum) {
  for (const int depth : {0, 1, 5}) {
    const std::string scene =
        TestHeader("\"path\" \"integer maxdepth\" [" + std::to_string(depth) + "]", 8, 8, 64) +
        FurnaceWorld(1, R"("matte" "color Kd" [.5 .5 .5])");
    double truth = 0;
    for (int i = 0; i <= depth + 1; ++i) truth += std::pow(.5, i);
    EXPECT_TRUE(IsWithin(.003, Mean(scene), truth)) << depth;
  }
}

// A delta lobe and a diffuse lobe are sampled and weighted under one mask. The sphere emits e,
// reflects .6 Kd and transmits .4 unchanged from a black sphere around it, which emits E inwards.
// The radiance is L = (e + .4 E) / (1 - .6 Kd).
TEST(PathFurnace, WithADeltaLobeBesideADiffuseOneHasTheClosedForm) {
  const std::string scene = TestHeader("\"path\" \"integer maxdepth\" [1000]", 8, 8, 128) +
                            R"(WorldBegin
ReverseOrientation
AttributeBegin
AreaLightSource "area" "color L" [1 1 1]
Material "uber" "color Kd" [.5 .5 .5] "color Ks" [0 0 0] "color opacity" [.6 .6 .6]
Shape "sphere"
AttributeEnd
AreaLightSource "area" "color L" [2 2 2]
Material "matte" "color Kd" [0 0 0]
Shape "sphere" "float radius" 2
WorldEnd
)";
  EXPECT_TRUE(IsWithin(.005, Mean(scene), (1 + .4 * 2) / (1 - .3)));
}

// A point light at the centre of a closed matte sphere gives the radiance a I / (pi R^2 (1 - a)).
TEST(PathFurnace, WithAPointLightInTheMiddleHasTheClosedForm) {
  const std::string scene = TestHeader("\"path\" \"integer maxdepth\" [1000]", 8, 8, 256) +
                            R"(WorldBegin
LightSource "point" "color I" [3.14159265 3.14159265 3.14159265]
Material "matte" "color Kd" [.5 .5 .5]
Shape "sphere"
WorldEnd
)";
  EXPECT_TRUE(IsWithin(.005, Mean(scene), 1));
}

// A small lamp is visible only through a perfect mirror or a pane without refraction. Emission
// after specular bounces must count once and in full.
TEST(Emission, ThroughSpecularBouncesIsSeenInFull) {
  for (const char* integrator : {"whitted", "directlighting", "path", "guidedpath", "bidirectional",
                                 "igi", "irradiancecache"}) {
    const std::string scene =
        TestHeader("\"" + std::string(integrator) + "\"", 4, 4, 4) + R"(WorldBegin
Material "glass" "float index" 1
Shape "trianglemesh" "integer indices" [0 1 2] "point P" [-9 -9 1  9 -9 1  0 9 1]
Material "mirror"
Shape "trianglemesh" "integer indices" [0 1 2] "point P" [-90 -90 2  90 -90 2  0 90 2]
AreaLightSource "area" "color L" [3 3 3]
Material "matte" "color Kd" [0 0 0]
ReverseOrientation
Shape "sphere" "float radius" 500
WorldEnd
)";
    EXPECT_TRUE(IsWithin(1e-4, Mean(scene), 3)) << integrator;
  }
}

TEST(Scene, WithoutLightsIsBlackButOpaque) {
  for (const char* integrator : {"whitted", "directlighting", "path", "guidedpath", "bidirectional",
                                 "igi", "irradiancecache"}) {
    const auto render = RenderSceneText(
        TestHeader("\"" + std::string(integrator) + "\"", 4, 4, 4) +
        "WorldBegin\nTranslate 0 0 3\nShape \"sphere\" \"float radius\" 2.9\nWorldEnd\n");
    EXPECT_EQ(MeanRadiance(render.image), 0);
    EXPECT_EQ(MeanChannel(render.image, "A"), 1);
  }
}

TEST(Scene, ThatIsEmptyShowsItsSky) {
  for (const char* integrator : {"whitted", "directlighting", "path", "guidedpath", "bidirectional",
                                 "igi", "irradiancecache"}) {
    const auto render = RenderSceneText(TestHeader("\"" + std::string(integrator) + "\"", 4, 4, 4) +
                                        "WorldBegin\nLightSource \"infinite\" \"color L\" [2 2 2]\n"
                                        "LightSource \"distant\"\nWorldEnd\n");
    EXPECT_EQ(MeanRadiance(render.image), 2);
    EXPECT_EQ(MeanChannel(render.image, "A"), 1);
  }
}

TEST(Scene, ThatIsEmptyAndDarkIsTransparent) {
  const auto render = RenderSceneText(TestHeader("\"path\"", 4, 4, 4) + "WorldBegin\nWorldEnd\n");
  EXPECT_EQ(MeanChannel(render.image, "A"), 0);
}

}  // namespace
}  // namespace exphoton
