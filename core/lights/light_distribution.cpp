// SPDX-License-Identifier: BSD-2-Clause
// LightDistribution weights each light by the luminance of its power, mixed with a uniform share.
#include "core/lights/light_distribution.h"

namespace exphoton {

double UsablePower(const Light& light) {
  const double power = double(light.Power().Y());
  return std::isfinite(power) && power > 0 ? power : 0;
}

LightDistribution::LightDistribution(const std::vector<std::unique_ptr<Light>>& lights,
                                     LightSelection selection, double uniformShare,
                                     std::span<const double> powerFactors) {
  std::vector<double> power(lights.size(), 0.0);
  double sum = 0;
  int shining = 0;
  for (std::size_t i = 0; i < lights.size(); ++i) {
    lights_.push_back(lights[i].get());
    if (lights[i]->IsProvablyBlack()) continue;
    ++shining;
    power[i] = UsablePower(*lights[i]) * (powerFactors.empty() ? 1 : powerFactors[i]);
    sum += power[i];
  }
  const bool byPower = selection == LightSelection::Power && sum > 0;
  std::vector<double> weights(lights.size(), 0.0);
  for (std::size_t i = 0; i < lights.size(); ++i) {
    if (lights[i]->IsProvablyBlack()) continue;
    const double uniform = 1.0 / shining;
    weights[i] = byPower ? (1 - uniformShare) * (power[i] / sum) + uniformShare * uniform : uniform;
  }
  distribution_ = DiscreteDistribution(weights);
}

LightDistribution::Choice LightDistribution::Sample(Real u) const {
  const DiscreteDistribution::Choice choice = distribution_.Sample(u);
  return {lights_[std::size_t(choice.index)], choice.index, choice.probability, choice.remapped};
}

}  // namespace exphoton
