// SPDX-License-Identifier: BSD-2-Clause
// CausticLights knows which lights provably make no caustics: the cone of their emission misses all
// boxes of specular surfaces, or these boxes lie behind an area light. Their paths for caustics
// keep their numbers and count, but nothing is emitted. The maps have the same bits as without this
// proof.
#pragma once

#include <vector>

#include "core/scene/scene.h"
#include "core/transport/specular/specular_boxes.h"

namespace exphoton {

class CausticLights {
 public:
  CausticLights() = default;  // no light is known
  // With --effects all, nothing is proved.
  explicit CausticLights(const Scene& scene);

  // `light` is a place in Scene::Lights.
  bool IsOutOfReach(int light) const {
    return !isOutOfReach_.empty() && isOutOfReach_[std::size_t(light)];
  }
  int OutOfReachCount() const { return outOfReach_; }  // black lights do not count
  // Returns whether no light can make caustics, because all that shine are out of reach.
  bool AreImpossible() const { return outOfReach_ > 0 && outOfReach_ == shining_; }

 private:
  std::vector<bool> isOutOfReach_;  // empty: no light is
  int outOfReach_ = 0, shining_ = 0;
};

}  // namespace exphoton
