// SPDX-License-Identifier: BSD-2-Clause
// CompareGathers compares photon maps with an exact value or with paths, in closed spheres where
// one step of theirs makes much of the light. The seed chooses one of three:
// - Glass and mirrors in a furnace: most gather rays and photons pass them, and each radiance is 1.
// - A mesh whose normals at the vertices are turned by up to 45 degrees: photons are scattered and
//   read where shading normal and geometric normal disagree.
// - Glossy walls, with gathers that pixels share and without.
#pragma once

#include <vector>

#include "tests/random/scenes/agreement.h"

namespace exphoton::random_scenes {

std::vector<Comparison> CompareGathers(const SceneModel& scene, const Effort& effort);
std::string GathersText(const SceneModel& scene, std::uint64_t seed);

}  // namespace exphoton::random_scenes
