// SPDX-License-Identifier: BSD-2-Clause
// FocusedScene changes a random scene so that its first body has properties that are rare together.
#pragma once

#include <cstdint>

#include "tests/random/scenes/scene_model.h"

namespace exphoton::random_scenes {

// The first body is no box, with each other shape equally often. It is often stretched, turned and
// moved, and it emits or is an instance. Subdivided meshes are open.
SceneModel FocusedScene(const SceneModel& scene, std::uint64_t seed);

// Returns a lamp of any shape without a room. It is often stretched, turned and moved.
SceneModel LoneLamp(std::uint64_t seed);

// Returns the focused scene for half of the seeds, else the scene itself.
SceneModel SometimesFocused(const SceneModel& scene, std::uint64_t seed);

}  // namespace exphoton::random_scenes
