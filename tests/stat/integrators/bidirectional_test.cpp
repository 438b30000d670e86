// SPDX-License-Identifier: BSD-2-Clause
// These tests compare bidirectional path tracing with closed forms and with path tracing, and check
// that the weights of all techniques of a path sum to 1.
#include <gtest/gtest.h>

#include <random>

#include "integrators/lightpaths/path_weight.h"
#include "tests/stat/integrators/comparison.h"

namespace exphoton {
namespace {

SeedEstimate Mean(const std::string& scene) {
  return EstimateOverSeeds([&](std::uint64_t seed) {
    TestRenderOptions options;
    options.seed = seed;
    return MeanRadiance(RenderSceneText(scene, options).image);
  });
}

// Returns whether technique s can make the path. The path itself needs a technique that can.
bool IsPossible(const WholePath& path, int s) {
  const int k = int(path.vertices.size());
  const auto isSpecular = [&](int i) { return path.vertices[std::size_t(i - 1)].isSpecular; };
  if (s == 0) return !path.isDeltaLight;
  if (s == 1) return k > 1 && !isSpecular(k - 1);
  return s < k && path.hasLightPaths && !isSpecular(k - s) && !isSpecular(k - s + 1);
}

TEST(PathWeight, OfAllTechniquesSumsToOne) {
  std::mt19937 engine(7);
  std::uniform_real_distribution<double> exponent(-6, 6), unit(0, 1);
  int paths = 0;
  for (int i = 0; i < 20000; ++i) {
    std::vector<VertexDensities> vertices(std::size_t(1 + i % 7));
    for (VertexDensities& v : vertices)
      v = {std::exp(exponent(engine)), std::exp(exponent(engine)), unit(engine) < .3};
    WholePath path{vertices, std::exp(exponent(engine)), unit(engine) < .3, unit(engine) < .8};
    if (path.isDeltaLight) vertices.back().fromCamera = 0;
    double sum = 0;
    int possible = 0;
    for (int s = 0; s <= std::max(int(vertices.size()) - 1, 0); ++s) {
      if (!IsPossible(path, s)) continue;
      ++possible;
      sum += PathWeight(path, s);
    }
    if (possible == 0) continue;
    ++paths;
    ASSERT_NEAR(sum, 1, 1e-9) << "path " << i << " of " << vertices.size() << " vertices";
  }
  EXPECT_GT(paths, 10000);
}

TEST(PathWeight, OfATechniqueWithTheHigherDensityIsHigher) {
  std::vector<VertexDensities> vertices(3);
  vertices[1] = {4, 1, false};
  vertices[2] = {1, 1, false};
  // p_0 = 4, p_1 = 4 direct, p_2 = 1.
  EXPECT_NEAR(PathWeight({vertices, 2, false, true}, 1), 64. / (16 + 64 + 1), 1e-12);
  EXPECT_NEAR(PathWeight({vertices, 2, false, true}, 2), 1. / (16 + 64 + 1), 1e-12);
}

TEST(BidirectionalFurnace, ShowsEmissionOverOneMinusAlbedo) {
  for (const double albedo : {.5, .8}) {
    const std::string a = std::to_string(albedo);
    const std::string scene =
        TestHeader("\"bidirectional\" \"integer maxdepth\" [200]", 8, 8, albedo > .7 ? 128 : 64) +
        FurnaceWorld(1, "\"matte\" \"color Kd\" [" + a + " " + a + " " + a + "]");
    EXPECT_TRUE(IsWithin(.01, Mean(scene), 1 / (1 - albedo))) << albedo;
  }
}

TEST(BidirectionalFurnace, OfALimitedDepthShowsAPartialSum) {
  for (const int depth : {0, 1, 2, 5}) {
    const std::string scene =
        TestHeader("\"bidirectional\" \"integer maxdepth\" [" + std::to_string(depth) + "]", 8, 8,
                   64) +
        FurnaceWorld(1, R"("matte" "color Kd" [.5 .5 .5])");
    double truth = 0;
    for (int i = 0; i <= depth + 1; ++i) truth += std::pow(.5, i);
    EXPECT_TRUE(IsWithin(.003, Mean(scene), truth)) << depth;
  }
}

// A point light at the centre of a closed matte sphere gives the radiance a I / (pi R^2 (1 - a)).
TEST(BidirectionalFurnace, WithAPointLightInTheMiddleHasTheClosedForm) {
  const std::string scene = TestHeader("\"bidirectional\" \"integer maxdepth\" [200]", 8, 8, 128) +
                            R"(WorldBegin
LightSource "point" "color I" [3.14159265 3.14159265 3.14159265]
Material "matte" "color Kd" [.5 .5 .5]
Shape "sphere"
WorldEnd
)";
  EXPECT_TRUE(IsWithin(.005, Mean(scene), 1));
}

std::string Quad(const std::string& points) {
  return "Shape \"trianglemesh\" \"integer indices\" [0 1 2 0 2 3] \"point P\" [" + points + "]\n";
}

// A room seen from its open side at z = 0, with a lamp under the ceiling.
const std::string kRoom =
    "Material \"matte\" \"color Kd\" [.7 .6 .5]\n" + Quad("-2 -2 0  2 -2 0  2 -2 5  -2 -2 5") +
    Quad("-2 2 0  2 2 0  2 2 5  -2 2 5") + Quad("-2 -2 5  2 -2 5  2 2 5  -2 2 5") +
    Quad("-2 -2 0  -2 -2 5  -2 2 5  -2 2 0") + Quad("2 -2 0  2 -2 5  2 2 5  2 2 0");
const std::string kLamp =
    "AttributeBegin\nAreaLightSource \"area\" \"color L\" [3 3 3]\nMaterial \"matte\"\n" +
    Quad("-1 1.9 2  1 1.9 2  1 1.9 4  -1 1.9 4") + "AttributeEnd\n";

struct World {
  const char* name;
  std::string text;
};

class BidirectionalAgreement : public testing::TestWithParam<World> {};

TEST_P(BidirectionalAgreement, WithPathTracingHoldsInEveryBlock) {
  const auto scene = [&](const std::string& integrator, int samples) {
    return "VolumeIntegrator \"emission\" \"float stepsize\" .3\n" +
           TestHeader(integrator + " \"integer maxdepth\" 5", 12, 12, samples) + "WorldBegin\n" +
           GetParam().text + "WorldEnd\n";
  };
  EXPECT_TRUE(AgreeInBlocks(.03, EstimateBlocks(scene("\"bidirectional\"", 80)),
                            EstimateBlocks(scene("\"path\"", 160))));
}

INSTANTIATE_TEST_SUITE_P(
    Worlds, BidirectionalAgreement,
    testing::Values(
        World{"matte", kRoom + kLamp},
        World{"caustic", kRoom + kLamp +
                             "AttributeBegin\nTranslate -.8 -1.2 3\nMaterial \"glass\"\n"
                             "Shape \"sphere\" \"float radius\" .7\nAttributeEnd\n"
                             "AttributeBegin\nTranslate 1 -1.3 4\nMaterial \"mirror\"\n"
                             "Shape \"sphere\" \"float radius\" .7\nAttributeEnd\n"},
        World{"glossy", kRoom + kLamp +
                            "AttributeBegin\nTranslate -.8 -1.2 3\nMaterial \"plastic\" \"color "
                            "Kd\" [.3 .3 .3] \"color Ks\" [.6 .6 .6] \"float roughness\" .1\n"
                            "Shape \"sphere\" \"float radius\" .7\nAttributeEnd\n"
                            "Material \"substrate\" \"float uroughness\" .2 \"float vroughness\" "
                            ".4\n" +
                            Quad("-2 -1.99 0  2 -1.99 0  2 -1.99 5  -2 -1.99 5")},
        World{"translucent", kRoom + kLamp +
                                 "Material \"translucent\" \"color Kd\" [.6 .6 .6] \"color Ks\" "
                                 "[.2 .2 .2] \"float roughness\" "
                                 ".2\n" +
                                 Quad("-1.5 0 1  1.5 0 1  1.5 0 4.5  -1.5 0 4.5") +
                                 "AttributeBegin\nTranslate 0 -1.3 3\nMaterial \"uber\" \"color "
                                 "opacity\" [.5 .5 .5] "
                                 "\"color Kd\" [.5 .5 .5] \"color Ks\" [.2 .2 .2] \"color Kr\" [.2 "
                                 ".2 .2]\nShape \"sphere\" \"float "
                                 "radius\" .6\nAttributeEnd\n"},
        World{"shading_normals",
              kRoom + kLamp +
                  "Shape \"trianglemesh\" \"integer indices\" [0 1 2 0 2 3] \"point P\" [-2 -1.9 0 "
                  "2 -1.9 0  2 -1.9 5  -2 -1.9 5] \"normal N\" [.8 .6 0  .8 .6 0  .8 .6 0  .8 .6 "
                  "0]\n"},
        World{"delta_lights",
              kRoom + "LightSource \"point\" \"point from\" [1 1 3] \"color I\" [2 2 2]\n"
                      "LightSource \"spot\" \"point from\" [-1.5 1.5 1] \"point to\" [0 -2 3] "
                      "\"color I\" [9 9 9]\n"},
        World{"sky", Quad("-9 -1 0  9 -1 0  9 -1 9  -9 -1 9") +
                         "LightSource \"infinite\" \"color L\" [.5 .6 .9]\nLightSource \"distant\" "
                         "\"point from\" [1 2 -1] \"point to\" [0 0 0]\nMaterial \"matte\" \"color "
                         "Kd\" [.8 .8 .8]\nAttributeBegin\nTranslate 0 0 4\nShape \"sphere\"\n"
                         "AttributeEnd\nTranslate 1.5 -.4 3\nShape \"sphere\" \"float radius\" "
                         ".5\n"},
        World{"media", kRoom + kLamp +
                           "Volume \"homogeneous\" \"point p0\" [-2 -2 0] \"point p1\" [2 2 5] "
                           "\"color sigma_a\" [.05 .05 .05] \"color sigma_s\" [.1 .1 .1] \"color "
                           "Le\" [.01 .01 .01]\n"}),
    [](const auto& info) { return std::string(info.param.name); });

// A lamp in a shade lights the ceiling, which lights the room. Connections to the ceiling find this
// light much more often than next event estimation does.
TEST(Bidirectional, FindsLightOverTheCeilingWithLessNoiseThanPathTracing) {
  const std::string world = "WorldBegin\n" + kRoom +
                            "AttributeBegin\nMaterial \"matte\" \"color Kd\" [0 0 "
                            "0]\nReverseOrientation\nAreaLightSource "
                            "\"area\" \"color L\" [90 90 90]\n" +
                            Quad("-.2 1 2.8  .2 1 2.8  .2 1 3.2  -.2 1 3.2") + "AttributeEnd\n" +
                            "Material \"matte\" \"color Kd\" [0 0 0]\n" +
                            Quad("-.5 .98 2.5  .5 .98 2.5  .5 .98 3.5  -.5 .98 3.5") +
                            Quad("-.5 .98 2.5  .5 .98 2.5  .5 1.6 2.5  -.5 1.6 2.5") +
                            Quad("-.5 .98 3.5  .5 .98 3.5  .5 1.6 3.5  -.5 1.6 3.5") +
                            Quad("-.5 .98 2.5  -.5 .98 3.5  -.5 1.6 3.5  -.5 1.6 2.5") +
                            Quad(".5 .98 2.5  .5 .98 3.5  .5 1.6 3.5  .5 1.6 2.5") + "WorldEnd\n";
  const auto spread = [&](const std::string& integrator) {
    return Mean(TestHeader(integrator, 8, 8, 16) + world).standardDeviation;
  };
  const auto mean = [&](const std::string& integrator) {
    return Mean(TestHeader(integrator, 8, 8, 64) + world);
  };
  EXPECT_LT(spread("\"bidirectional\""), .8 * spread("\"path\""));
  EXPECT_NEAR(mean("\"bidirectional\"").mean / mean("\"path\"").mean, 1, .1);
}

TEST(Bidirectional, GivesTheSameBitsForAnyNumberOfThreadsAndAnyTiles) {
  const std::string scene =
      TestHeader("\"bidirectional\"", 12, 10, 4) + "WorldBegin\n" + kRoom + kLamp + "WorldEnd\n";
  const Image one = RenderSceneText(scene).image;
  for (const int threads : {2, 3, 8}) {
    TestRenderOptions options;
    options.threads = threads;
    options.tileSize = threads;
    options.tileOrder = TileOrder::Reversed;
    EXPECT_EQ(RenderSceneText(scene, options).image.pixels, one.pixels) << threads;
  }
}

// A spot light shines into a glass ball. Its rays meet the floor, which lights the ceiling that the
// camera sees. Camera paths cannot find the light. Light paths do, unless they pass the ball again
// on their way up (about a tenth of the light does).
// Fog that begins behind the wall takes nothing from light within the room.
TEST(Bidirectional, LosesNoLightToFogBehindTheWalls) {
  const auto mean = [](const std::string& fog) {
    return MeanRadiance(
        RenderSceneText(TestHeader("\"bidirectional\"", 8, 8, 16) +
                        "WorldBegin\nLightSource \"point\" \"point from\" [.2 .3 -.2]\n" + fog +
                        "Material \"matte\" \"color Kd\" [.8 .8 .8]\nShape \"sphere\"\nWorldEnd\n")
            .image);
  };
  const double clear = mean("");
  EXPECT_NEAR(mean("Volume \"homogeneous\" \"point p0\" [-9 1.01 -9] \"point p1\" [9 9 9] \"color "
                   "sigma_a\" [1 1 1]\n"),
              clear, .001 * clear);
}

TEST(Bidirectional, FindsCausticsOfDeltaLightsOverOneMoreSurface) {
  const std::string world =
      "WorldBegin\nLightSource \"spot\" \"color I\" [30 30 30] \"point from\" [0 "
      "2.5 0] \"point to\" [0 0 0] \"float coneangle\" 15 \"float conedeltaangle\" 2\nMaterial "
      "\"matte\" \"color Kd\" [.7 .7 .7]\n" +
      Quad("-4 0 -4  4 0 -4  4 0 4  -4 0 4") + Quad("-4 3 -4  4 3 -4  4 3 4  -4 3 4") +
      "Material \"glass\"\nTranslate 0 2 0\nShape \"sphere\" \"float radius\" .15\nWorldEnd\n";
  const auto mean = [&](const std::string& integrator) {
    return Mean("LookAt 2 1 0  2 3 0  0 0 1\n" + TestHeader(integrator, 6, 6, 64) + world).mean;
  };
  EXPECT_EQ(mean("\"path\""), 0);
  const double photons = mean("\"photonmap\" \"integer indirectphotons\" 20000");
  EXPECT_NEAR(mean("\"bidirectional\" \"integer maxdepth\" 50") / photons, .9, .07);
}

TEST(Bidirectional, SplitsLightIntoTheAovsOfPathTracing) {
  const std::string world =
      "WorldBegin\n" + kRoom + kLamp +
      "AttributeBegin\nTranslate -.8 -1.2 3\nMaterial \"glass\"\nShape \"sphere\" \"float "
      "radius\" .7\nAttributeEnd\nWorldEnd\n";
  const std::vector<std::string> aovs{"emission", "direct", "indirect", "specular", "caustic"};
  const auto estimates = [&](const std::string& integrator) {
    std::vector<std::vector<double>> means(aovs.size());
    for (int k = 0; k < kGateSeeds; ++k) {
      TestRenderOptions options;
      options.seed = std::uint64_t(k) * 1000 + 1;
      options.aovs = kLightAovs;
      const Image image =
          RenderSceneText(TestHeader(integrator, 12, 12, 128) + world, options).image;
      for (std::size_t i = 0; i < aovs.size(); ++i)
        means[i].push_back(MeanChannel(image, aovs[i] + ".G"));
    }
    std::vector<SeedEstimate> result;
    for (const auto& seeds : means) result.push_back(EstimateFrom(seeds));
    return result;
  };
  const auto both = estimates("\"bidirectional\""), path = estimates("\"path\"");
  for (std::size_t i = 0; i < aovs.size(); ++i) {
    const double tolerance = aovs[i] == "caustic" ? .5 : .08;  // few samples carry most of it
    EXPECT_GT(path[i].mean, 0) << aovs[i];
    EXPECT_TRUE(IsWithin(tolerance, both[i], path[i].mean)) << aovs[i];
  }
}

}  // namespace
}  // namespace exphoton
