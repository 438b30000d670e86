// SPDX-License-Identifier: BSD-2-Clause
// Shrink reduces a scene that breaks a property to a simpler scene that also breaks it.
#pragma once

#include <functional>

#include "tests/random/scenes/scene_generator.h"

namespace exphoton::random_scenes {

struct ShrinkResult {
  SceneModel scene;
  int tries = 0;  // number of scenes tried
};

// `fails` returns whether a scene breaks the property. Shrink moves repeatedly to the first simpler
// scene that breaks it, until there is none or `maxTries` scenes have been tried.
ShrinkResult Shrink(const rc::Shrinkable<SceneModel>& failing,
                    const std::function<bool(const SceneModel&)>& fails, int maxTries);

}  // namespace exphoton::random_scenes
