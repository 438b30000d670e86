// SPDX-License-Identifier: BSD-2-Clause
// RandomScenes draws scenes with the generator of tests/random. It takes integrator, accelerator,
// sampler, filter and film from tables in turn, because the generator knows few of them.
#include <array>

#include "tests/random/scenes/scene_generator.h"
#include "tests/random/scenes/scene_text.h"
#include "tests/recorded/scene_list.h"

namespace exphoton::recorded {
namespace {

const std::vector<std::string> kRandomIntegrators{
    "\"exphotonmap\" \"integer directlights\" 2",
    "\"path\"",
    "\"photonmap\"",
    "\"bidirectional\"",
    "\"irradiancecache\" \"integer nsamples\" 16",
    "\"igi\" \"integer nlights\" 4 \"integer nsets\" 2 \"integer gathersamples\" 2",
    "\"directlighting\"",
    "\"whitted\"",
    "\"ambientocclusion\" \"integer nsamples\" 6",
    "\"debug\" \"string red\" \"nx\" \"string green\" \"ngy\" \"string blue\" \"z\"",
    "\"exphotonmap\" \"string photonroulette\" \"constant\" \"bool sharedgather\" \"true\"",
    "\"igi\" \"integer nlights\" 3 \"float glimit\" 2 \"float rrthreshold\" .3",
    "\"bidirectional\" \"integer maxdepth\" 2",
    "\"irradiancecache\" \"integer nsamples\" 9 \"integer maxindirectdepth\" 1",
    "\"photonmap\" \"bool directwithphotons\" \"true\" \"bool finalgather\" \"false\"",
    "\"path\" \"integer maxdepth\" 2",
    "\"exphotonmap\" \"string gathersampling\" \"bsdf\" \"bool radiancephotons\" \"false\"",
    "\"directlighting\" \"string strategy\" \"weighted\"",
    "\"debug\" \"string red\" \"distance\" \"string green\" \"facing\" \"string blue\" \"u\"",
};

const std::array<const char*, 3> kAccelerators{"bvh", "kdtree", "bruteforce"};

const std::vector<std::string> kSamplers{
    "\"lowdiscrepancy\" \"integer pixelsamples\" 2",
    "\"stratified\" \"integer xsamples\" 2 \"integer ysamples\" 1",
    "\"halton\" \"integer pixelsamples\" 2",
    "\"random\" \"integer xsamples\" 1 \"integer ysamples\" 2",
    "\"bestcandidate\" \"integer pixelsamples\" 2",
    "\"stratified\" \"integer xsamples\" 1 \"integer ysamples\" 2 \"bool jitter\" \"false\"",
    "\"adaptive\" \"integer minsamples\" 1 \"integer maxsamples\" 2",
};

const std::vector<std::string> kFilters{
    "\"box\"",      "\"gaussian\"",
    "\"mitchell\"", "\"triangle\" \"float xwidth\" 1 \"float ywidth\" .7",
    "\"sinc\"",
};

const std::array<const char*, 2> kAovs{"albedo,N,P,variance,samples",
                                       "light,photonDensity,radianceDistance"};

template <class List>
auto InTurn(const List& list, std::uint64_t seed) {
  return list[std::size_t(seed % list.size())];
}

RecordedScene SceneOf(std::uint64_t seed) {
  const auto shrinkable = random_scenes::SceneOfSeed(seed);
  random_scenes::TextOptions options;
  options.integrator = InTurn(kRandomIntegrators, seed);
  options.accelerator = InTurn(kAccelerators, seed);
  options.photons = 150;
  options.gatherRays = 4;
  options.maxPhotonPaths = 4000;
  RecordedScene scene{
      "random/" + std::to_string(seed), random_scenes::SceneText(shrinkable.value(), options), {}};
  ReplaceLine("Sampler", "Sampler " + InTurn(kSamplers, seed), &scene.text);
  ReplaceLine("PixelFilter", "PixelFilter " + InTurn(kFilters, seed), &scene.text);
  const std::string sources = std::string(EXPHOTON_SOURCE_DIR) + "/";
  for (std::size_t at; (at = scene.text.find(sources)) != std::string::npos;)
    scene.text.erase(at, sources.size());
  std::string unknown;
  if (seed % 6 == 0) scene.aovs = ParseAovs(InTurn(kAovs, seed / 6), &unknown).value();
  return scene;
}

}  // namespace

std::vector<RecordedScene> RandomScenes(std::uint64_t firstSeed, std::uint64_t lastSeed) {
  return OfSeeds(firstSeed, lastSeed, SceneOf);
}

}  // namespace exphoton::recorded
