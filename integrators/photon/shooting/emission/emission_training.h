// SPDX-License-Identifier: BSD-2-Clause
// EmissionTraining learns an EmissionGuide from paths. Each path reports the numbers of its
// emission and the power of the photons that the map would keep. The result depends on the samples
// and their order alone.
#pragma once

#include <span>
#include <vector>

#include "integrators/photon/maps/photon.h"
#include "integrators/photon/shooting/emission/emission_guide.h"

namespace exphoton {

// EmissionSample is the result of one path from a light.
struct EmissionSample {
  std::array<float, EmissionNumbers::kDimensions> u;
  int light;
  float inverseDensity;  // of light and numbers, as drawn
  // For each map that kept photons of the path, the luminance with which it left the light, before
  // the division by the density; else 0.
  std::array<float, kPhotonKindCount> kept;
};

// LearnEmission learns where photons of one map start. The density minimises the product of time
// and variance of the kept power, if a path takes more time where it keeps photons: it is
// proportional to the root of the mean square of `kept` over the mean time. A part `defensive` of
// the paths is spread as without a guide, by `base`, the probabilities of the lights. `dimensions`
// is EmissionNumbers::kDimensions, or less if the last numbers are not used. If no sample kept
// anything, the guide is empty.
struct EmissionGoal {
  PhotonKind map;
  std::span<const double> base;
  double defensive;
  int dimensions;
};
EmissionGuide LearnEmission(std::span<const EmissionSample> samples, const EmissionGoal& goal);

}  // namespace exphoton
