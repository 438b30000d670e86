// SPDX-License-Identifier: BSD-2-Clause
// Shrink descends greedily in rapidcheck's tree of simpler scenes.
#include "tests/random/scenes/shrinking.h"

namespace exphoton::random_scenes {

ShrinkResult Shrink(const rc::Shrinkable<SceneModel>& failing,
                    const std::function<bool(const SceneModel&)>& fails, int maxTries) {
  ShrinkResult result;
  rc::Shrinkable<SceneModel> best = failing;
  bool hasImproved = true;
  while (hasImproved && result.tries < maxTries) {
    hasImproved = false;
    auto simpler = best.shrinks();
    while (result.tries < maxTries) {
      const auto next = simpler.next();
      if (!next) break;
      ++result.tries;
      if (!fails(next->value())) continue;
      best = *next;
      hasImproved = true;
      break;
    }
  }
  result.scene = best.value();
  return result;
}

}  // namespace exphoton::random_scenes
