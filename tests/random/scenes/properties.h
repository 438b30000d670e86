// SPDX-License-Identifier: BSD-2-Clause
// What must hold exactly of every random scene: the picture does not depend on the plan of effects,
// on threads and tiles, on the accelerator, nor on a factor of a matrix, and every pixel is finite
// and at least 0.
#pragma once

#include <string>

#include "tests/random/scenes/scene_model.h"

namespace exphoton::random_scenes {

// Empty where all hold; else a sentence that names what differs.
std::string BrokenInvariance(const SceneModel& scene);

}  // namespace exphoton::random_scenes
