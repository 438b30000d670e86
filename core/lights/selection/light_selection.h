// SPDX-License-Identifier: BSD-2-Clause
// LightSelection lists the ways of choosing lights. The factories below make the LightSampler of
// each way; no other code decides how lights are chosen.
#pragma once

#include "core/lights/selection/fixed_light_sampler.h"
#include "core/lights/selection/light_sampler.h"

namespace exphoton {

enum class LightSelection {
  Uniform,    // all lights with the same probability
  Power,      // by power; 5 % of the choices are uniform
  HalfPower,  // by power; half of the choices are uniform, because power ignores distance
  Tree,       // by power and distance, in time proportional to the logarithm of the lights' number
  Auto,       // Tree if at least 16 lights are not provably black, HalfPower otherwise
};

// `world` is the bounding sphere that the lights were prepared with. The lights must outlive the
// sampler.
std::unique_ptr<const LightSampler> MakeLightSampler(std::span<const std::unique_ptr<Light>> lights,
                                                     const Sphere3& world,
                                                     LightSelection selection);

// Makes the sampler of the lights that photons leave. There is no point, so Tree and Auto act as
// Power. powerFactors: see PowerLightSampler.
std::unique_ptr<const FixedLightSampler> MakeEmissionLightSampler(
    std::span<const std::unique_ptr<Light>> lights, LightSelection selection,
    std::span<const double> powerFactors);

}  // namespace exphoton
