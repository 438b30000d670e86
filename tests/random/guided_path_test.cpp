// SPDX-License-Identifier: BSD-2-Clause
// guidedpath is unbiased: in blocks of pixels of several scenes its means are those of path. Each
// block is compared by Welch's t-test without a margin, and the false discovery rate over all
// blocks is 1 %.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/random/scenes/statistics.h"
#include "tests/support/test_scene.h"

namespace exphoton {
namespace {

using random_scenes::PValueBeyond;
using random_scenes::Rejected;
using random_scenes::Sample;
using random_scenes::SampleOf;

constexpr int kSeeds = 8, kSide = 16, kBlocks = 4;
constexpr double kFalseDiscoveryRate = .01;

struct Comparison {
  std::string name;
  std::string world;
  int pathSamples = 64, guidedSamples = 16;
};

// A box whose walls reflect, open at the top.
const std::string kBox =
    "Shape \"trianglemesh\" \"integer indices\" [0 1 2 0 2 3  4 5 6 4 6 7  0 1 5 0 5 4  "
    "1 2 6 1 6 5  2 3 7 2 7 6  3 0 4 3 4 7] \"point P\" [-2 -2 -2  2 -2 -2  2 2 -2  -2 2 -2  "
    "-2 -2 4  2 -2 4  2 2 4  -2 2 4]\n";
const std::string kWhite = "Material \"matte\" \"color Kd\" [.7 .6 .5]\n";
// The lamp lights a small spot of a wall, so nearly all light is indirect.
const std::string kSpot =
    "LightSource \"spot\" \"point from\" [1 1.5 -1] \"point to\" [-2 -.5 1] \"color I\" [40 40 40] "
    "\"float coneangle\" 12\n";
const std::string kLamp =
    "AttributeBegin\nAreaLightSource \"area\" \"color L\" [9 9 9]\nTranslate 1.2 1.5 0\n"
    "Shape \"sphere\" \"float radius\" .3\nAttributeEnd\n";
const std::string kBall = "Translate 0 -.3 2\nShape \"sphere\" \"float radius\" .8\n";

std::vector<Comparison> Scenes() {
  return {
      {"spot", kSpot + kWhite + kBox, 256, 16},
      {"area light", kLamp + kWhite + kBox + kBall},
      {"glossy", kLamp + "Material \"plastic\" \"float roughness\" .15\n" + kBox +
                     "Material \"uber\" \"color Kr\" [.3 .3 .3] \"float roughness\" .3\n" + kBall},
      {"translucent", kLamp + kWhite + kBox + "Material \"translucent\"\n" + kBall},
      {"mirror",
       "AttributeBegin\nAreaLightSource \"area\" \"color L\" [4 4 4]\nTranslate 1 1 0\n"
       "Shape \"sphere\" \"float radius\" .7\nAttributeEnd\n" +
           kWhite + kBox + "Material \"mirror\"\n" + kBall,
       256, 64},
      {"sky", "LightSource \"infinite\" \"color L\" [1 .8 .6]\n" + kWhite + kBall +
                  "Translate 0 -5.2 0\nShape \"sphere\" \"float radius\" 4\n"},
      {"medium",
       "Volume \"homogeneous\" \"color sigma_a\" [.1 .1 .1] \"color sigma_s\" [.2 .2 .2] "
       "\"point p0\" [-2 -2 -2] \"point p1\" [2 2 4]\n" +
           kLamp + kWhite + kBox},
      {"motion", kLamp + kWhite + kBox +
                     "ActiveTransform EndTime\nTranslate .6 0 0\nActiveTransform All\n" + kBall},
  };
}

std::vector<Sample> BlocksOf(const std::string& integrator, const std::string& world, int samples,
                             std::uint64_t firstSeed) {
  std::vector<std::vector<double>> means(kBlocks * kBlocks);
  const std::string media = world.find("Volume") == std::string::npos
                                ? ""
                                : "VolumeIntegrator \"single\" \"float stepsize\" .5\n";
  const std::string scene =
      TestHeader(integrator, kSide, kSide, samples) + media + "WorldBegin\n" + world + "WorldEnd\n";
  for (int k = 0; k < kSeeds; ++k) {
    TestRenderOptions options;
    options.seed = firstSeed + std::uint64_t(k) * 1000;
    options.threads = 2;
    const Image image = RenderSceneText(scene, options).image;
    for (int b = 0; b < kBlocks * kBlocks; ++b) {
      constexpr int kSize = kSide / kBlocks;
      const int x = b % kBlocks * kSize, y = b / kBlocks * kSize;
      means[std::size_t(b)].push_back(MeanRadiance(image, {x, y, x + kSize, y + kSize}));
    }
  }
  std::vector<Sample> blocks;
  for (const auto& values : means) blocks.push_back(SampleOf(values));
  return blocks;
}

TEST(GuidedPath, HasTheMeansOfPathInEveryBlock) {
  std::vector<double> chances;
  std::vector<std::string> names;
  for (const Comparison& scene : Scenes()) {
    const auto path =
        BlocksOf("\"path\" \"integer maxdepth\" 20", scene.world, scene.pathSamples, 1);
    const auto guided =
        BlocksOf("\"guidedpath\" \"integer maxdepth\" 20 \"integer indirectphotons\" 5000",
                 scene.world, scene.guidedSamples, 2);
    for (std::size_t b = 0; b < path.size(); ++b) {
      EXPECT_GT(path[b].mean, 0) << scene.name;
      chances.push_back(PValueBeyond(guided[b], path[b], 0));
      names.push_back(scene.name + ", block " + std::to_string(b) + ": guided " +
                      std::to_string(guided[b].mean) + ", path " + std::to_string(path[b].mean));
    }
  }
  for (const std::size_t i : Rejected(chances, kFalseDiscoveryRate))
    ADD_FAILURE() << names[i] << ", p = " << chances[i];
}

}  // namespace
}  // namespace exphoton
