// SPDX-License-Identifier: BSD-2-Clause
// ComparePairs renders a random scene with two settings that have the same expected picture. The
// seed chooses the pair of settings. Errors of weights and probabilities differ between the two.
#pragma once

#include <vector>

#include "tests/random/scenes/agreement.h"

namespace exphoton::random_scenes {

std::vector<Comparison> ComparePairs(const SceneModel& scene, const Effort& effort);

// Returns the scene file with the first settings of the pair.
std::string PairText(const SceneModel& scene, std::uint64_t seed);

// Compares photon maps with paths, or with their own density estimates, in a closed sphere of one
// material. Its walls are glossy, or fog in it scatters or glows, so that most of the light takes
// the way that is compared. A pair takes few samples.
std::vector<Comparison> ComparePhotons(const SceneModel& scene, const Effort& effort);
std::string PhotonText(const SceneModel& scene, std::uint64_t seed);

}  // namespace exphoton::random_scenes
