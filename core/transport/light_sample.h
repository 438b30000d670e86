// SPDX-License-Identifier: BSD-2-Clause
// SampledLight is a sampled point on a chosen light. FromLightSample returns its MIS-weighted
// contribution, with the power heuristic against BSDF samples (Veach 1997, section 9.2). All
// estimators of direct light share this code.
#pragma once

#include "core/transport/integrator.h"
#include "core/transport/shading_point.h"

namespace exphoton {

struct SampledLight {
  const Light* light;
  Real probability = 1;  // probability of choosing this light
  Point2 place;          // uniform in [0,1)^2: position on the light
  Real part = 0;         // uniform in [0,1): part of the light
};

// The number of samples of each technique. A delta light has light samples only.
struct TechniqueCounts {
  int light = 1, bsdf = 1;
};

// Returns f L |cos| weight / (probability pdf) for `lobes` only. The BSDF samples must use the same
// lobes. The caller divides by counts.light.
Spectrum FromLightSample(const ShadingPoint& point, const SampledLight& sample,
                         TechniqueCounts counts, LobeSet lobes, LiContext& context);

}  // namespace exphoton
