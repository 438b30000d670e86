// SPDX-License-Identifier: BSD-2-Clause
// What must hold in the mean: path, photonmap and exphotonmap agree, and no picture is brighter
// than the energy that its scene gets. Each function returns one-sided p-values, to be judged over
// a whole run (run.h); none of them is a verdict.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "tests/random/scenes/scene_model.h"

namespace exphoton::random_scenes {

struct Comparison {
  std::string what;
  double chance = 1;      // that chance alone gives such a difference beyond the margin
  double difference = 0;  // of the two means
  std::string detail;     // the two means and their standard errors
};

// How much a comparison may cost.
struct Effort {
  int factor = 1;        // multiplies samples and photons: 1 at the first look, 16 at the second
  int photonFactor = 1;  // multiplies the photons once more
  std::uint64_t firstSeed = 1;
};

// The scene without what one of the integrators is stated not to find, or to find with a bias that
// has no bound (agreement.cpp lists them).
SceneModel WithoutKnownDifferences(const SceneModel& scene);

// The integrators' pictures of one scene, rendered when they are first compared.
class IntegratorLook {
 public:
  IntegratorLook(const SceneModel& scene, const Effort& effort);
  IntegratorLook(IntegratorLook&&) noexcept;
  ~IntegratorLook();

  // All comparisons; with `only` those of the two integrators of the comparison of that name.
  // None where the picture is far darker than the lamps.
  std::vector<Comparison> Compare(const std::string& only = "");

 private:
  struct Rendered;
  std::unique_ptr<Rendered> rendered_;
};

std::vector<Comparison> CompareWithEnergy(const SceneModel& scene, const Effort& effort);

// The scene files that were compared, for a report.
std::string AgreementText(const SceneModel& scene);
std::string EnergyText(const SceneModel& scene);

}  // namespace exphoton::random_scenes
