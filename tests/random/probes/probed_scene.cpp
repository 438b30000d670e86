// SPDX-License-Identifier: BSD-2-Clause
// ProbedScene loads a scene with every feature on, so that all of its parts are there.
#include "tests/random/probes/probed_scene.h"

#include <array>
#include <cstdio>
#include <exception>

#include "core/math/sampling/sampling.h"
#include "tests/random/probes/focused_scene.h"
#include "tests/random/probes/sampling_probe.h"

namespace exphoton::random_scenes {
namespace {

constexpr int kProbeRays = 160;

LoadedScene LoadedWithAllFeatures(const std::string& text) {
  LoadOptions options;
  options.effects = "all";
  return LoadSceneText(text, options);
}

}  // namespace

Point2 NextPoint(RandomStream* random) {
  const Real x = random->Uniform();
  return {x, random->Uniform()};
}

Ray RandomRay(RandomStream* random, Interval times) {
  constexpr Real kHalf = Real(1.9);
  Ray ray;
  for (int axis = 0; axis < 3; ++axis) ray.o[axis] = kHalf * (2 * random->Uniform() - 1);
  ray.d = SampleUniformSphere(NextPoint(random));
  ray.time = Lerp(random->Uniform(), times.min, times.max);
  return ray;
}

ProbedScene::ProbedScene(const std::string& text, std::uint64_t seed, int rays)
    : loaded_(LoadedWithAllFeatures(text)), seed_(seed) {
  RandomStream random = Stream(1);
  for (int i = 0; i < rays; ++i)
    if (const auto sight = Look(RandomRay(&random, World().Exposure()))) sights_.push_back(*sight);
}

std::optional<Sight> ProbedScene::Look(const Ray& ray) const {
  const auto hit = World().IntersectPoint(ray);
  if (!hit) return std::nullopt;
  return Sight{ray, *hit, World().Complete(ray, hit->hit)};
}

void Findings::Expect(bool isRight, const char* check, double value, double expected) {
  if (isRight || text_.find(check) != std::string::npos) return;
  char line[160];
  std::snprintf(line, sizeof line, "%s: %.6g and %.6g; ", check, value, expected);
  text_ += line;
}

std::string BrokenProbe(const SceneModel& drawn, std::uint64_t seed) {
  constexpr std::array<const char*, 4> kAccelerators{"bvh", "kdtree", "bruteforce", "bvh"};
  try {
    Findings findings;
    const SceneModel model = SometimesFocused(drawn, seed);
    TextOptions options;
    options.accelerator = kAccelerators[std::size_t(seed % kAccelerators.size())];
    const ProbedScene scene(SceneText(model, options), seed, kProbeRays);
    ProbeSurfaces(scene, &findings);
    ProbeCamera(scene, &findings);
    ProbeScattering(scene, &findings);
    ProbeLamps(model, scene, &findings);
    ProbeLights(scene, &findings);
    ProbeLoneLamps(seed, &findings);
    ProbeLightPaths(scene, &findings);
    ProbeMedia(model, scene, &findings);
    ProbeEmission(model, scene, &findings);
    ProbeTextures(seed, &findings);
    ProbeMeshes(seed, &findings);
    ProbeSampling(scene, seed, &findings);
    ProbeVersions(model, seed, &findings);
    return findings.Text();
  } catch (const std::exception& error) {
    return std::string("an error: ") + error.what();
  }
}

}  // namespace exphoton::random_scenes
