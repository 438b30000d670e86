// SPDX-License-Identifier: BSD-2-Clause
// LightSampler: chooses one light for a point, and states the probability of that choice. A few
// lights are chosen by power alone; many by the light tree, which also knows distances.
#pragma once

#include <unordered_map>

#include "core/lights/light_distribution.h"
#include "core/lights/light_tree.h"
#include "core/scene/scene.h"

namespace exphoton {

class LightSampler {
 public:
  LightSampler() = default;  // no light
  // The scene must outlive this. Half of the choices by power are uniform.
  explicit LightSampler(const Scene& scene);

  bool IsEmpty() const { return lights_.IsEmpty(); }  // every light is black
  LightTree::Choice Sample(const Point3& p, Real u) const {
    if (!tree_.IsEmpty()) return tree_.Sample(p, u);
    const auto choice = lights_.Sample(u);
    return {choice.light, choice.index, choice.probability};
  }
  // The probability with which Sample chooses a light of the scene at p; 0 for a black one.
  Real Probability(const Point3& p, const Light& light) const {
    const int index = indices_.at(&light);
    return tree_.IsEmpty() ? lights_.Probability(index) : tree_.Probability(p, index);
  }

 private:
  LightDistribution lights_;
  LightTree tree_;  // empty where lights are few
  std::unordered_map<const Light*, int> indices_;
};

}  // namespace exphoton
