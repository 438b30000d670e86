// SPDX-License-Identifier: BSD-2-Clause
// FixedLightSampler tabulates the weights. The functions here compute the weights of each kind.
#include "core/lights/selection/fixed_light_sampler.h"

namespace exphoton {
namespace {

using LightSpan = std::span<const std::unique_ptr<Light>>;

std::vector<double> UniformWeights(LightSpan lights) {
  int shining = 0;
  for (const auto& light : lights) shining += !light->IsProvablyBlack();
  std::vector<double> weights(lights.size(), 0.0);
  for (std::size_t i = 0; i < lights.size(); ++i)
    if (!lights[i]->IsProvablyBlack()) weights[i] = 1.0 / shining;
  return weights;
}

std::vector<double> PowerWeights(LightSpan lights, double uniformShare,
                                 std::span<const double> powerFactors) {
  std::vector<double> weights = UniformWeights(lights), power(lights.size(), 0.0);
  double sum = 0;
  for (std::size_t i = 0; i < lights.size(); ++i) {
    if (lights[i]->IsProvablyBlack()) continue;
    power[i] = UsablePower(*lights[i]) * (powerFactors.empty() ? 1 : powerFactors[i]);
    sum += power[i];
  }
  if (!(sum > 0)) return weights;
  for (std::size_t i = 0; i < lights.size(); ++i)
    weights[i] = (1 - uniformShare) * (power[i] / sum) + uniformShare * weights[i];
  return weights;
}

}  // namespace

FixedLightSampler::FixedLightSampler(LightSpan lights, std::span<const double> weights)
    : LightSampler(lights), distribution_(weights) {}

LightSampler::Choice FixedLightSampler::Sample(Real u) const {
  const DiscreteDistribution::Choice choice = distribution_.Sample(u);
  return {LightAt(choice.index), choice.index, choice.probability, choice.remapped};
}

UniformLightSampler::UniformLightSampler(LightSpan lights)
    : FixedLightSampler(lights, UniformWeights(lights)) {}

PowerLightSampler::PowerLightSampler(LightSpan lights, double uniformShare,
                                     std::span<const double> powerFactors)
    : FixedLightSampler(lights, PowerWeights(lights, uniformShare, powerFactors)) {}

}  // namespace exphoton
