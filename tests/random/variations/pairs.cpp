// SPDX-License-Identifier: BSD-2-Clause
// A pair of path integrators has exactly the same expected picture, with the same limit of bounces.
// Settings of the photon maps decide how many samples go where. Their density estimates have a bias
// that may depend a little on the density of the photons, so there is a margin.
//
// Light tracing finds caustics of delta lights, which path tracing cannot find, so `bidirectional`
// is compared in a scene without them (WithoutKnownDifferences). The light of glowing media on
// surfaces is found by the paths that leave a surface, which directlighting does not have.
#include "tests/random/variations/pairs.h"

#include <array>
#include <cmath>
#include <cstdio>

#include "core/math/sampling/random.h"
#include "tests/random/scenes/scene_text.h"
#include "tests/random/scenes/statistics.h"
#include "tests/support/test_scene.h"

namespace exphoton::random_scenes {
namespace {

constexpr int kPairSeeds = 6, kPairSamples = 4;
constexpr int kPairWidth = 8, kPairHeight = 6;

struct SettingsPair {
  const char* name;  // of the integrator of both
  const char* first;
  const char* second;
  double margin = 0;  // relative to a part of the light
  enum class Dropped { Nothing, Caustics, Glow } dropped = Dropped::Nothing;
  double pictureMargin = 0;  // relative to the picture: blur takes light from bright places
};
using enum SettingsPair::Dropped;

constexpr std::array<SettingsPair, 15> kSettingsPairs{{
    {"directlighting", R"("string strategy" "all")", R"("string strategy" "weighted")"},
    {"directlighting", R"("string strategy" "all")", R"("string strategy" "near")"},
    {"directlighting", R"("string strategy" "all")", R"("string strategy" "one")"},
    {"", R"("path" "integer maxdepth" 0)", R"("directlighting" "integer maxdepth" 0)", 0, Glow},
    {"", R"("path" "integer maxdepth" 2)", R"("guidedpath" "integer maxdepth" 2)"},
    {"", R"("path" "integer maxdepth" 2)", R"("bidirectional" "integer maxdepth" 2)", 0, Caustics},
    {"", R"("path" "integer maxdepth" 4)", R"("bidirectional" "integer maxdepth" 4)", 0, Caustics},
    {"exphotonmap", R"("float rrthreshold" 0)", R"("float rrthreshold" 2)", .01},
    {"exphotonmap", R"("string gathersampling" "bsdf")", R"("string gathersampling" "photons")",
     .01},
    {"exphotonmap", R"("string gathersampling" "bsdf")", R"("string gathersampling" "jensen")",
     .01},
    {"exphotonmap", R"("bool sharedgather" "false")", R"("bool sharedgather" "true")", .01},
    {"exphotonmap", R"("integer directlights" 1)", R"("integer directlights" 8)", .01},
    {"photonmap", R"("string gathersampling" "bsdf")", R"("string gathersampling" "photons")", .01},
    {"exphotonmap", R"("string photonroulette" "luminance")",
     R"("string photonroulette" "maxcomponent")", .05, Nothing, .01},
    {"photonmap", R"("string lightselection" "power")", R"("string lightselection" "uniform")", .05,
     Nothing, .01},
}};

const SettingsPair& PairOf(std::uint64_t seed) {
  return kSettingsPairs[std::size_t(HashKey({seed, 19}) % kSettingsPairs.size())];
}

SceneModel PairScene(const SceneModel& scene, const SettingsPair& pair) {
  if (pair.dropped == Caustics) return WithoutKnownDifferences(scene);
  SceneModel same = scene;
  if (pair.dropped == Glow)
    for (MediumModel& medium : same.media)
      if (medium.parts > 1) medium.parts = 1;
  return same;
}

std::string SettingText(const SettingsPair& pair, const char* setting) {
  return *pair.name ? "\"" + std::string(pair.name) + "\" " + setting : setting;
}

std::string PairSceneText(const SceneModel& scene, const std::string& integrator, int factor) {
  TextOptions options;
  options.integrator = integrator;
  options.samples = kPairSamples * factor;
  // The blur of density estimates falls with more photons, a defect does not.
  options.photons = 500 * factor, options.maxPhotonPaths = 10000 * factor, options.gatherRays = 6;
  options.width = kPairWidth, options.height = kPairHeight;
  return SceneText(scene, options);
}

constexpr std::array<const char*, 5> kParts{"R", "direct.R", "caustic.R", "indirect.R",
                                            "specular.R"};

using PartMeans = std::array<std::vector<double>, kParts.size()>;

PartMeans MeansOf(const std::string& text, std::uint64_t firstSeed) {
  PartMeans means;
  for (int k = 0; k < kPairSeeds; ++k) {
    TestRenderOptions options;
    options.seed = firstSeed + std::uint64_t(k) * 1000;
    options.footprintSamples = 1 << 20;
    for (const Aov aov : {Aov::Direct, Aov::Caustic, Aov::Indirect, Aov::Specular})
      options.aovs.Add(aov);
    const Image image = RenderSceneText(text, options).image;
    for (std::size_t i = 0; i < kParts.size(); ++i)
      means[i].push_back(MeanChannel(image, kParts[i]));
  }
  return means;
}

}  // namespace

std::vector<Comparison> ComparePairs(const SceneModel& scene, const Effort& effort) {
  const SettingsPair& pair = PairOf(effort.sceneSeed);
  const SceneModel same = PairScene(scene, pair);
  const std::string first = SettingText(pair, pair.first), second = SettingText(pair, pair.second);
  const PartMeans a = MeansOf(PairSceneText(same, first, effort.factor), effort.firstSeed);
  const PartMeans b = MeansOf(PairSceneText(same, second, effort.factor), effort.firstSeed + 7);
  std::vector<Comparison> comparisons;
  for (std::size_t i = 0; i < kParts.size(); ++i) {
    const Sample left = SampleOf(a[i]), right = SampleOf(b[i]);
    const double size = std::max(left.mean, right.mean);
    // Sums of float pixels in another order differ in the last digits.
    const double picture = std::max(SampleOf(a[0]).mean, SampleOf(b[0]).mean);
    const double margin = std::max(pair.margin, 1e-5) * size + pair.pictureMargin * picture;
    char detail[120];
    std::snprintf(detail, sizeof detail, "%.5g +- %.2g against %.5g +- %.2g", left.mean,
                  std::sqrt(left.variance), right.mean, std::sqrt(right.variance));
    comparisons.push_back({first + " against " + second + ", " + kParts[i],
                           PValueBeyond(left, right, margin), left.mean - right.mean, detail});
  }
  return comparisons;
}

std::string PairText(const SceneModel& scene, std::uint64_t seed) {
  const SettingsPair& pair = PairOf(seed);
  return PairSceneText(PairScene(scene, pair), SettingText(pair, pair.first), 1);
}

}  // namespace exphoton::random_scenes
