// SPDX-License-Identifier: BSD-2-Clause
// ProbedScene is a random scene that is loaded but not rendered, with hits of random rays. Probes
// are checks of its parts at these hits: surfaces, scattering, lights and media. They need no
// picture, so they are cheap and hardly noisy.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/math/sampling/random.h"
#include "tests/random/scenes/scene_text.h"
#include "tests/support/test_scene.h"

namespace exphoton::random_scenes {

// Sight is a ray with the surface that it hits.
struct Sight {
  Ray ray;
  Scene::HitPoint hit;
  SurfaceInteraction surface;
};

class ProbedScene {
 public:
  // Traces `rays` random rays through the room, at random times of the exposure.
  ProbedScene(const std::string& text, std::uint64_t seed, int rays);

  const Scene& World() const { return *loaded_.setup->scene; }
  const Camera& Eye() const { return *loaded_.setup->camera; }
  const RenderSetup& Setup() const { return *loaded_.setup; }
  const std::vector<Sight>& Sights() const { return sights_; }
  // Returns a stream of random numbers for one purpose.
  RandomStream Stream(std::uint64_t purpose) const {
    return RandomStream(HashKey({seed_, purpose}));
  }
  // Returns the first hit of a ray.
  std::optional<Sight> Look(const Ray& ray) const;

 private:
  LoadedScene loaded_;
  std::uint64_t seed_;
  std::vector<Sight> sights_;
};

// Returns a ray from a random point of the room, in a random direction.
Ray RandomRay(RandomStream* random, Interval times);
Point2 NextPoint(RandomStream* random);

// Findings collects the first broken check of each name.
class Findings {
 public:
  // Notes a failure unless `isRight`. The numbers are for the report.
  void Expect(bool isRight, const char* check, double value, double expected);
  bool IsEmpty() const { return text_.empty(); }
  const std::string& Text() const { return text_; }

 private:
  std::string text_;
};

// Each probe adds what it finds wrong.
void ProbeSurfaces(const ProbedScene& scene, Findings* findings);
void ProbeCamera(const ProbedScene& scene, Findings* findings);
void ProbeScattering(const ProbedScene& scene, Findings* findings);
void ProbeLamps(const SceneModel& model, const ProbedScene& scene, Findings* findings);
void ProbeLights(const ProbedScene& scene, Findings* findings);
// Checks scenes that have a lamp and nothing else.
void ProbeLoneLamps(std::uint64_t seed, Findings* findings);
void ProbeMedia(const SceneModel& model, const ProbedScene& scene, Findings* findings);
// Compares the densities of light paths, which weigh the techniques of `bidirectional`.
void ProbeLightPaths(const ProbedScene& scene, Findings* findings);
// Compares point lights with maps or cones, and skies, with a second implementation of them.
void ProbeEmission(const SceneModel& model, const ProbedScene& scene, Findings* findings);
// Compare textures, bumps and meshes of a random scene of their own with other implementations.
void ProbeTextures(std::uint64_t seed, Findings* findings);
void ProbeMeshes(std::uint64_t seed, Findings* findings);
// Compare a scene with other descriptions of the same scene.
void ProbeVersions(const SceneModel& scene, std::uint64_t seed, Findings* findings);

// Returns "" if all probes succeed, or else a sentence.
std::string BrokenProbe(const SceneModel& scene, std::uint64_t seed);

}  // namespace exphoton::random_scenes
