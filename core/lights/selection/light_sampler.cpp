// SPDX-License-Identifier: BSD-2-Clause
// LightSampler: the lights and their indices, which all implementations share.
#include "core/lights/selection/light_sampler.h"

#include <algorithm>
#include <cmath>

namespace exphoton {

LightSampler::LightSampler(std::span<const std::unique_ptr<Light>> lights)
    : isEmpty_(std::all_of(lights.begin(), lights.end(),
                           [](const auto& light) { return light->IsProvablyBlack(); })) {
  for (const auto& light : lights) {
    indices_.emplace(light.get(), int(lights_.size()));
    lights_.push_back(light.get());
  }
}

LightSampler::~LightSampler() = default;

int LightSampler::IndexOf(const Light& light) const { return indices_.at(&light); }

double UsablePower(const Light& light) {
  const double power = double(light.Power().Y());
  return std::isfinite(power) && power > 0 ? power : 0;
}

}  // namespace exphoton
