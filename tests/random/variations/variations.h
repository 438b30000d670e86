// SPDX-License-Identifier: BSD-2-Clause
// BrokenVariation renders a random scene twice: as it is, and with one change that keeps every bit
// of the picture. The seed chooses the change, so a long run tries each of them with many scenes at
// the cost of two small pictures a scene.
#pragma once

#include <cstdint>
#include <string>

#include "tests/random/scenes/scene_model.h"

namespace exphoton::random_scenes {

// Returns "" if the two pictures are equal and every pixel is finite and at least 0, or else a
// sentence.
std::string BrokenVariation(const SceneModel& scene, std::uint64_t seed);

// Returns the name of the change that the seed chooses.
std::string VariationName(const SceneModel& scene, std::uint64_t seed);

}  // namespace exphoton::random_scenes
