// SPDX-License-Identifier: BSD-2-Clause
// LightSampler chooses one light for a shading point and returns the probability of the choice. It
// samples few lights by power. It samples many lights by the light tree, which also considers
// distance.
#pragma once

#include <unordered_map>

#include "core/lights/light_distribution.h"
#include "core/lights/light_tree.h"
#include "core/scene/scene.h"

namespace exphoton {

class LightSampler {
 public:
  LightSampler() = default;  // no light
  // The scene must outlive this object. Power sampling chooses uniformly in half of the cases.
  explicit LightSampler(const Scene& scene);

  bool IsEmpty() const { return lights_.IsEmpty(); }  // every light is black
  LightTree::Choice Sample(const Point3& p, Real u) const {
    if (!tree_.IsEmpty()) return tree_.Sample(p, u);
    const auto choice = lights_.Sample(u);
    return {choice.light, choice.index, choice.probability};
  }
  // Returns the probability that Sample chooses `light` at p; 0 for a black light.
  Real Probability(const Point3& p, const Light& light) const {
    const int index = indices_.at(&light);
    return tree_.IsEmpty() ? lights_.Probability(index) : tree_.Probability(p, index);
  }

 private:
  LightDistribution lights_;
  LightTree tree_;  // empty if there are few lights
  std::unordered_map<const Light*, int> indices_;
};

}  // namespace exphoton
