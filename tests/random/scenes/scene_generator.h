// SPDX-License-Identifier: BSD-2-Clause
// SceneGenerator draws random scenes. It combines rapidcheck's generators.
#pragma once

#include <rapidcheck.h>

#include <cstdint>

#include "tests/random/scenes/scene_model.h"

namespace exphoton::random_scenes {

rc::Gen<SceneModel> SceneGenerator();

// Returns the scene of a seed with its simpler variants.
rc::Shrinkable<SceneModel> SceneOfSeed(std::uint64_t seed);

}  // namespace exphoton::random_scenes
