// SPDX-License-Identifier: BSD-2-Clause
// BrokenInvariance tests properties that hold exactly for every random scene. The picture does not
// depend on feature culling, threads, tiles, the accelerator, or a factor of a matrix. Every pixel
// is finite and at least 0.
#pragma once

#include <string>

#include "tests/random/scenes/scene_model.h"

namespace exphoton::random_scenes {

// Returns "" if all properties hold, or else a sentence that names the difference.
std::string BrokenInvariance(const SceneModel& scene);

}  // namespace exphoton::random_scenes
