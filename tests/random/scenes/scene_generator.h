// SPDX-License-Identifier: BSD-2-Clause
// The generator of random scenes, made of rapidcheck's generators.
#pragma once

#include <rapidcheck.h>

#include <cstdint>

#include "tests/random/scenes/scene_model.h"

namespace exphoton::random_scenes {

rc::Gen<SceneModel> SceneGenerator();

// The scene of a seed, and the simpler ones next to it.
rc::Shrinkable<SceneModel> SceneOfSeed(std::uint64_t seed);

}  // namespace exphoton::random_scenes
