// SPDX-License-Identifier: BSD-2-Clause
// These tests check that the picture plus its corrections has the true mean, with photon maps of
// small and of large bias. They also check that corrections leave the picture alone.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "core/render/certificate/corrections.h"
#include "tests/support/equivalence.h"
#include "tests/support/test_scene.h"

namespace exphoton {
namespace {

struct Means {
  double picture, correction;  // of R, G and B over all pixels
};

Means Render(const std::string& scene, std::uint64_t seed, int threads = 1) {
  LoadedScene loaded = LoadSceneText(scene);
  Corrections corrections(loaded.setup->crop, .25);
  TestRenderOptions options;
  options.seed = seed;
  options.threads = threads;
  options.corrections = &corrections;
  Means means{MeanRadiance(RenderLoaded(loaded, options).image), 0};
  const auto samples = loaded.setup->sampler->SamplesPerPixel();
  corrections.EndPass(0, samples);
  const Corrections::Group& group = *corrections.Groups().front();
  for (const double sum : group.sums)
    means.correction += sum / double(samples) / double(group.sums.size());
  return means;
}

std::string Integrator(const std::string& name, const std::string& parameters) {
  return "\"" + name + "\" " + parameters;
}

constexpr const char* kMatte = "\"matte\" \"color Kd\" [.7 .7 .7]";

// A corner of a floor and a wall, lit by a spot light that the camera does not see. The box round
// it reflects little light.
std::string Corner(const std::string& wall = kMatte) {
  const auto quad = [](const char* corners) {
    return std::string("Shape \"trianglemesh\" \"integer indices\" [0 1 2 0 2 3] \"point P\" [") +
           corners + "]\n";
  };
  return "WorldBegin\nLightSource \"spot\" \"point from\" [-1 .8 3] \"point to\" [.3 -1 4] "
         "\"float coneangle\" [20] \"color I\" [40 40 40]\n"
         "Material \"matte\" \"color Kd\" [.6 .5 .4]\n" +
         quad("-2 -1 0 2 -1 0 2 -1 5 -2 -1 5") + "Material " + wall + "\n" +
         quad("-2 -1 5 2 -1 5 2 2 5 -2 2 5") + "WorldEnd\n";
}

// The truth is the mean of four pictures by guidedpath with 4096 samples a pixel and maxdepth 30,
// which differ by .03 %.
struct LitCorner {
  const char* wall;
  double truth;  // mean of R, G and B over the picture
};
constexpr LitCorner kMatteCorner{kMatte, .0102302};
constexpr LitCorner kGlossyCorner{
    "\"plastic\" \"color Kd\" [.5 .5 .5] \"color Ks\" [.3 .3 .3] \"float roughness\" [.2]",
    .0091605};

// Radiance photons of few photons, and density estimates of a fifth of the photons, reach far over
// the edge of the lit disk and into the corner. The picture is more than 5 % too bright.
constexpr const char* kFewPhotons =
    "\"integer indirectphotons\" [500] \"integer nused\" [100] \"float maxdist\" [3] \"float "
    "radiancereach\" [12] ";
constexpr const char* kWideEstimates =
    "\"integer indirectphotons\" [2000] \"integer nused\" [400] \"float maxdist\" [1.5] ";

void ExpectTrueMean(const std::string& integrator, const std::string& photons,
                    const LitCorner& corner, int seeds) {
  const std::string world = Corner(corner.wall);
  const std::string scene =
      TestHeader(
          Integrator(integrator, photons + "\"float shortrays\" [0] \"float radiancenormal\" [.01] "
                                           "\"integer finalgathersamples\" [8]"),
          24, 24, 16) +
      world;
  const auto corrected = EstimateOverSeeds(
      [&](std::uint64_t seed) {
        const Means means = Render(scene, seed);
        return means.picture + means.correction;
      },
      seeds);
  EXPECT_GT(Render(scene, 1).picture, 1.05 * corner.truth) << "the bias is too small to test";
  EXPECT_TRUE(IsWithin(.015, corrected, corner.truth));
}

TEST(CorrectedCorner, HasTheTrueMeanWithRadiancePhotonsOfLongReach) {
  ExpectTrueMean("exphotonmap", kFewPhotons, kMatteCorner, 48);
}
TEST(CorrectedCorner, HasTheTrueMeanWithGlossyWalls) {
  ExpectTrueMean("exphotonmap", kFewPhotons, kGlossyCorner, 64);
}
TEST(CorrectedCorner, HasTheTrueMeanWithWideDensityEstimates) {
  ExpectTrueMean("photonmap", kWideEstimates, kMatteCorner, 24);
}

// A narrow spot light makes a small bright disk behind the camera. Radiance photons blur its edge,
// so the corrections of rays to the disk are large. Roulette that does not look at the light of a
// ray would multiply the few that it keeps.
TEST(CorrectedRoom, HasCorrectionsOfLittleScatter) {
  const std::string scene =
      TestHeader(Integrator("exphotonmap",
                            "\"integer indirectphotons\" [5000] \"integer nused\" [200] \"integer "
                            "finalgathersamples\" [8]"),
                 16, 16, 4) +
      "WorldBegin\nLightSource \"spot\" \"point from\" [0 0 1] \"point to\" [.5 0 -3] "
      "\"float coneangle\" [4] \"float conedeltaangle\" [1] \"color I\" [400 400 400]\nMaterial " +
      kMatte + "\nShape \"sphere\" \"float radius\" [4]\nWorldEnd\n";
  constexpr int kSeeds = 48;
  std::array<double, 3> scatters;  // relative, each of kSeeds pictures
  for (std::size_t group = 0; group < scatters.size(); ++group) {
    double picture = 0, sum = 0, squares = 0;
    for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
      const Means means = Render(scene, 1000 * group + seed);
      picture += means.picture / kSeeds;
      sum += means.correction;
      squares += means.correction * means.correction;
    }
    scatters[group] = std::sqrt((squares - sum * sum / kSeeds) / (kSeeds - 1)) / picture;
  }
  // One picture of about 1000 has a rare large correction, so the median counts. Measured: .07, and
  // .15 with roulette by the albedo alone.
  std::ranges::sort(scatters);
  EXPECT_LT(scatters[1], .1);
}

// Chains of corrections would not end if each had more corrections than its parent.
TEST(Corrections, EndBetweenSurfacesThatGainEnergy) {
  const std::string scene =
      TestHeader(Integrator("photonmap",
                            "\"integer indirectphotons\" [200] \"integer finalgathersamples\" [4]"),
                 8, 8, 4) +
      FurnaceWorld(1,
                   "\"plastic\" \"color Kd\" [1 1 1] \"color Ks\" [1 1 1] \"float roughness\" .2");
  EXPECT_TRUE(std::isfinite(Render(scene, 1).correction));
}

// A corner of two small squares, which see a ball of light only in a mirror behind the camera. A
// screen is between them, and a black wall is behind them. `mirror` false: the ball is where its
// mirror image would be. The light is the same for all small radii of the ball.
std::string MirroredLight(bool mirror, double radius = 1) {
  const auto quad = [](const std::string& corners) {
    return "Shape \"trianglemesh\" \"integer indices\" [0 1 2 0 2 3] \"point P\" [" + corners +
           "]\n";
  };
  const std::string z = mirror ? "4" : "-8", light = std::to_string(50 / (radius * radius));
  return "WorldBegin\nAttributeBegin\nTranslate 3.5 0 " + z +
         "\nAreaLightSource \"area\" \"color L\" [" + light + " " + light + " " + light +
         "]\nMaterial \"matte\" \"color Kd\" [0 0 0]\nShape \"sphere\" \"float radius\" [" +
         std::to_string(radius) +
         "]\nAttributeEnd\n"
         "Material \"matte\" \"color Kd\" [.9 .9 .9]\n" +
         quad("-.5 -.5 3 .5 -.5 3 .5 .5 3 -.5 .5 3") +
         quad("-.5 -.5 2 .5 -.5 2 .5 -.5 3 -.5 -.5 3") +
         "Material \"matte\" \"color Kd\" [0 0 0]\n" + quad("1 -3 1.9 1 3 1.9 1 3 6 1 -3 6") +
         quad("-3 -3 6 3 -3 6 3 3 6 -3 3 6") +
         (mirror ? "Material \"mirror\" \"color Kr\" [1 1 1]\n" +
                       quad("-9 -9 -2 9 -9 -2 9 9 -2 -9 9 -2")
                 : "") +
         "WorldEnd\n";
}

// A picture of the squares alone.
std::string SquaresHeader(const std::string& integrator, int samples) {
  std::string header = TestHeader(integrator, 12, 12, samples);
  return header.replace(header.find("[90]"), 4, "[30]");
}

// The searches for photons reach far beyond the squares, where there is no photon, so the picture
// is too dark.
const std::string kWideSearches =
    Integrator("exphotonmap",
               "\"integer causticphotons\" [2000] \"integer indirectphotons\" [2000] \"integer "
               "maxphotonpaths\" [200000] \"integer nused\" [400] \"float maxdist\" [2] \"integer "
               "finalgathersamples\" [8]");

TEST(CorrectedCaustic, HasTheTrueMeanOnSmallSurfaces) {
  const std::string scene = SquaresHeader(kWideSearches, 64) + MirroredLight(true);
  const double truth =
      Render(SquaresHeader(Integrator("path", ""), 4096) + MirroredLight(false), 1).picture;
  const auto corrected = EstimateOverSeeds(
      [&](std::uint64_t seed) {
        const Means means = Render(scene, seed);
        return means.picture + means.correction;
      },
      16);
  EXPECT_LT(Render(scene, 1).picture, .9 * truth) << "the bias is too small to test";
  EXPECT_TRUE(IsWithin(.02, corrected, truth));
}

// Rays nearly always miss so small a ball. Those that hit it would make corrections many times as
// bright as the picture, so the kernel is corrected instead.
TEST(CorrectedCaustic, HasLittleScatterIfRaysMissTheLight) {
  const std::string scene = SquaresHeader(kWideSearches, 16) + MirroredLight(true, .02);
  constexpr int kSeeds = 16;
  std::vector<double> relative;
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    const Means means = Render(scene, seed);
    ASSERT_GT(means.picture, 0);
    relative.push_back(means.correction / means.picture);
  }
  const auto [least, most] = std::ranges::minmax(relative);
  EXPECT_LT(most - least, .5);
}

class CorrectedFurnace : public testing::TestWithParam<std::tuple<const char*, double>> {};

TEST_P(CorrectedFurnace, ShowsEmissionOverOneMinusAlbedo) {
  const auto [integrator, albedo] = GetParam();
  const std::string value = std::to_string(albedo);
  const std::string scene =
      TestHeader(Integrator(integrator,
                            "\"integer indirectphotons\" [5000] \"integer finalgathersamples\" "
                            "[16] \"string photonroulette\" \"luminance\""),
                 10, 10, 16) +
      FurnaceWorld(1, "\"matte\" \"color Kd\" [" + value + " " + value + " " + value + "]");
  const auto corrected = EstimateOverSeeds(
      [&](std::uint64_t seed) {
        const Means means = Render(scene, seed);
        return means.picture + means.correction;
      },
      16);
  EXPECT_TRUE(IsWithin(.01, corrected, 1 / (1 - albedo)));
}

INSTANTIATE_TEST_SUITE_P(PhotonIntegrators, CorrectedFurnace,
                         testing::Values(std::tuple("photonmap", .5),
                                         std::tuple("exphotonmap", .8)));

TEST(Corrections, LeaveThePictureAloneAndDoNotDependOnThreads) {
  const std::string scene =
      TestHeader(Integrator("exphotonmap", "\"integer indirectphotons\" [2000]"), 24, 24, 4) +
      Corner();
  TestRenderOptions options;
  const TestRender plain = RenderSceneText(scene, options);
  LoadedScene loaded = LoadSceneText(scene);
  Corrections corrections(loaded.setup->crop, .1);
  options.corrections = &corrections;
  EXPECT_EQ(RenderLoaded(loaded, options).image.pixels, plain.image.pixels);
  EXPECT_EQ(Render(scene, 1, 3).correction, Render(scene, 1, 1).correction);
}

}  // namespace
}  // namespace exphoton
