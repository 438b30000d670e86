// SPDX-License-Identifier: BSD-2-Clause
// Shrinking of a scene that breaks a property: the smallest scene on the way that breaks it too.
#pragma once

#include <functional>

#include "tests/random/scenes/scene_generator.h"

namespace exphoton::random_scenes {

struct ShrinkResult {
  SceneModel scene;
  int tries = 0;  // scenes that were tried
};

// `fails` says whether a scene breaks the property. Goes to the first simpler scene that does,
// again and again, until none does or `maxTries` have been tried.
ShrinkResult Shrink(const rc::Shrinkable<SceneModel>& failing,
                    const std::function<bool(const SceneModel&)>& fails, int maxTries);

}  // namespace exphoton::random_scenes
