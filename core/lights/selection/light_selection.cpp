// SPDX-License-Identifier: BSD-2-Clause
// LightSelection: the factories of light samplers.
#include "core/lights/selection/light_selection.h"

#include <algorithm>

#include "core/lights/selection/tree_light_sampler.h"

namespace exphoton {
namespace {

constexpr double kHalfUniformShare = 0.5;
// With fewer lights, the light tree's better choices do not repay the time of its traversal.
constexpr int kFewestLightsOfTree = 16;

bool UsesTree(std::span<const std::unique_ptr<Light>> lights, LightSelection selection) {
  if (selection != LightSelection::Auto) return selection == LightSelection::Tree;
  return std::count_if(lights.begin(), lights.end(), [](const auto& light) {
           return !light->IsProvablyBlack();
         }) >= kFewestLightsOfTree;
}

}  // namespace

std::unique_ptr<const LightSampler> MakeLightSampler(std::span<const std::unique_ptr<Light>> lights,
                                                     const Sphere3& world,
                                                     LightSelection selection) {
  if (UsesTree(lights, selection)) return std::make_unique<TreeLightSampler>(lights, world);
  if (selection == LightSelection::Auto) selection = LightSelection::HalfPower;
  return MakeEmissionLightSampler(lights, selection, {});
}

std::unique_ptr<const FixedLightSampler> MakeEmissionLightSampler(
    std::span<const std::unique_ptr<Light>> lights, LightSelection selection,
    std::span<const double> powerFactors) {
  if (selection == LightSelection::Uniform) return std::make_unique<UniformLightSampler>(lights);
  const double uniformShare =
      selection == LightSelection::HalfPower ? kHalfUniformShare : PowerLightSampler::kUniformShare;
  return std::make_unique<PowerLightSampler>(lights, uniformShare, powerFactors);
}

}  // namespace exphoton
