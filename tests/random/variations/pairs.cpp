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

#include "core/math/sampling/random.h"
#include "tests/random/probes/rooms.h"
#include "tests/random/variations/parts.h"

namespace exphoton::random_scenes {
namespace {

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

enum class Ingredient { Gloss, ScatteringFog, GlowingFog };

struct PhotonPair {
  Ingredient ingredient;
  const char* first;
  const char* second;
  bool hasEqualSeeds = false;
};
constexpr double kPhotonMargin = .05;  // for the blur of photon maps
constexpr const char* kLongPaths = R"("path" "integer maxdepth" 60)";
constexpr const char* kDeepPhotonMap = R"("photonmap" "integer maxdepth" 24)";
constexpr const char* kDeepExPhotonMap = R"("exphotonmap" "integer maxdepth" 24)";
constexpr const char* kDeepEstimates =
    R"("exphotonmap" "integer maxdepth" 24 "bool radiancephotons" "false")";
constexpr std::array<PhotonPair, 6> kPhotonPairs{{
    {Ingredient::Gloss, kDeepExPhotonMap, kDeepEstimates, true},
    {Ingredient::Gloss, kDeepExPhotonMap, kLongPaths},
    {Ingredient::ScatteringFog, kDeepPhotonMap, kLongPaths},
    {Ingredient::ScatteringFog, kDeepExPhotonMap, kLongPaths},
    {Ingredient::GlowingFog, kDeepPhotonMap, kLongPaths},
    {Ingredient::GlowingFog, kDeepExPhotonMap, kLongPaths},
}};

const PhotonPair& PhotonPairOf(std::uint64_t seed) {
  return kPhotonPairs[std::size_t(HashKey({seed, 21}) % kPhotonPairs.size())];
}

SceneModel PhotonSphere(const SceneModel& drawn, std::uint64_t seed) {
  const Ingredient ingredient = PhotonPairOf(seed).ingredient;
  RandomStream random(HashKey({seed, 22}));
  const auto choose = [&](int count) { return int(random.Bits() % std::uint64_t(count)); };
  SceneModel scene = PhotonRoom(drawn, seed);
  scene.room = RoomKind::Sphere;
  scene.bodies.clear(), scene.media.clear();
  scene.lights = {{.colour = {9, 8, 7}, .place = {choose(5) - 2, choose(5) - 2, choose(3) - 3}}};
  scene.volumeIntegrator = 0;
  if (ingredient == Ingredient::Gloss) {
    constexpr std::array<MaterialKind, 3> kGlossy{MaterialKind::Plastic, MaterialKind::Substrate,
                                                  MaterialKind::Metal};
    scene.walls.kind = kGlossy[std::size_t(choose(3))];
    scene.walls.share = 2, scene.walls.roughness = choose(2);
    return scene;
  }
  scene.walls.kind = MaterialKind::Matte;
  scene.walls.share = 0;
  MediumModel fog{.kind = choose(3), .scattered = {9, 8, 7}, .emitted = {2, 2, 2}};
  fog.parts = ingredient == Ingredient::ScatteringFog ? 1 : 2;
  fog.phase = choose(3);
  scene.media = {fog};
  scene.volumeIntegrator = ingredient == Ingredient::ScatteringFog ? 2 : 1 + choose(2);
  if (ingredient == Ingredient::GlowingFog) scene.lights.clear();
  return scene;
}

}  // namespace

std::vector<Comparison> ComparePairs(const SceneModel& scene, const Effort& effort) {
  const SettingsPair& pair = PairOf(effort.sceneSeed);
  const SceneModel same = PairScene(scene, pair);
  const std::string first = SettingText(pair, pair.first), second = SettingText(pair, pair.second);
  // The blur of density estimates falls with more photons, a defect does not.
  const auto means = [&](const std::string& integrator, std::uint64_t seed) {
    return MeansOf(SmallSceneText(same, integrator, effort.factor, effort.factor), seed);
  };
  const PartMeans a = means(first, effort.firstSeed);
  const PartMeans b = means(second, effort.firstSeed + 7);
  return CompareParts(first + " against " + second, a, b, {pair.margin, pair.pictureMargin}, false);
}

std::string PairText(const SceneModel& scene, std::uint64_t seed) {
  const SettingsPair& pair = PairOf(seed);
  return SmallSceneText(PairScene(scene, pair), SettingText(pair, pair.first), 1, 1);
}

std::vector<Comparison> ComparePhotons(const SceneModel& scene, const Effort& effort) {
  const PhotonPair& pair = PhotonPairOf(effort.sceneSeed);
  const SceneModel sphere = PhotonSphere(scene, effort.sceneSeed);
  const auto means = [&](const char* integrator, std::uint64_t seed) {
    return MeansOf(SmallSceneText(sphere, integrator, effort.factor, 4 * effort.factor), seed);
  };
  const PartMeans a = means(pair.first, effort.firstSeed);
  const PartMeans b = means(pair.second, effort.firstSeed + (pair.hasEqualSeeds ? 0 : 7));
  return CompareParts(std::string(pair.first) + " against " + pair.second, a, b, {kPhotonMargin},
                      pair.hasEqualSeeds);
}

std::string PhotonText(const SceneModel& scene, std::uint64_t seed) {
  return SmallSceneText(PhotonSphere(scene, seed), PhotonPairOf(seed).first, 1, 4);
}

}  // namespace exphoton::random_scenes
