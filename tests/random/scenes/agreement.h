// SPDX-License-Identifier: BSD-2-Clause
// What must hold in the mean: path, photonmap and exphotonmap agree, and no picture is brighter
// than the energy that its scene gets. Each function returns one-sided p-values, to be judged over
// a whole run (run.h); none of them is a verdict.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tests/random/scenes/scene_model.h"

namespace exphoton::random_scenes {

struct Comparison {
  std::string what;
  double chance = 1;   // that chance alone gives such a difference beyond the margin
  std::string detail;  // the two means and their standard errors
};

// 1 for the first look, 16 for the second: multiplies samples and photons.
struct Effort {
  int factor = 1;
  std::uint64_t firstSeed = 1;
};

// The scene without what one of the integrators is stated not to find, or to find with a bias that
// has no bound (agreement.cpp lists them).
SceneModel WithoutKnownDifferences(const SceneModel& scene);

std::vector<Comparison> CompareIntegrators(const SceneModel& scene, const Effort& effort);
std::vector<Comparison> CompareWithEnergy(const SceneModel& scene, const Effort& effort);

// The scene files that were compared, for a report.
std::string AgreementText(const SceneModel& scene);
std::string EnergyText(const SceneModel& scene);

}  // namespace exphoton::random_scenes
