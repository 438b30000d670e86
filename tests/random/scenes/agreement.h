// SPDX-License-Identifier: BSD-2-Clause
// IntegratorComparison and CompareWithEnergy test properties of means: path, guidedpath, photonmap
// and exphotonmap agree, and no picture is brighter than its scene's energy allows. Each function
// returns one-sided p-values, which are judged over a whole run (run.h). A single p-value is not a
// verdict.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "tests/random/scenes/scene_model.h"

namespace exphoton::random_scenes {

struct Comparison {
  std::string what;
  double chance = 1;      // p-value: probability of such a difference beyond the margin
  double difference = 0;  // of the two means
  std::string detail;     // the two means and their standard errors
};

// Effort limits the cost of a comparison.
struct Effort {
  int factor = 1;        // for samples and photons: 1 in the first stage, 16 in the second
  int photonFactor = 1;  // additional factor for the photons
  std::uint64_t firstSeed = 1;
  std::uint64_t sceneSeed = 1;  // of choices that belong to the scene, such as points
  bool comparesMore = false;    // also the light AOVs, and bidirectional with path
};

// Returns the scene without everything that an integrator is documented not to find, or to find
// with an unbounded bias (agreement.cpp lists these cases).
SceneModel WithoutKnownDifferences(const SceneModel& scene);

// IntegratorComparison renders one scene with each integrator when the picture is first needed.
class IntegratorComparison {
 public:
  IntegratorComparison(const SceneModel& scene, const Effort& effort);
  IntegratorComparison(IntegratorComparison&&) noexcept;
  ~IntegratorComparison();

  // Returns all comparisons, or with `only` those of the two integrators in the comparison of that
  // name. Without `only`, returns none if the picture is far darker than the emitters.
  std::vector<Comparison> Compare(const std::string& only = "");

 private:
  struct Rendered;
  std::unique_ptr<Rendered> rendered_;
};

std::vector<Comparison> CompareWithEnergy(const SceneModel& scene, const Effort& effort);

// Return the scene files that were compared, for a report.
std::string AgreementText(const SceneModel& scene);
std::string EnergyText(const SceneModel& scene);

}  // namespace exphoton::random_scenes
