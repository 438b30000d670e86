// SPDX-License-Identifier: BSD-2-Clause
// SampledLight: light that reaches a point from one sampled place on one light, weighted against
// samples of the BSDF by the power heuristic (Veach 1997, section 9.2). What every estimate of
// direct light has in common.
#pragma once

#include "core/transport/integrator.h"
#include "core/transport/shading_point.h"

namespace exphoton {

struct SampledLight {
  const Light* light;
  Real probability = 1;  // with which this light was chosen among others
  Point2 place;          // uniform variates: where on the light
  Real part = 0;         // uniform: on which of its parts
};

// How many samples of each technique share the light; a delta light has no other technique.
struct TechniqueCounts {
  int light = 1, bsdf = 1;
};

// f L |cos| weight / (probability pdf): of `lobes` alone, which those of the BSDF samples must be.
// To be divided by counts.light.
Spectrum FromLightSample(const ShadingPoint& point, const SampledLight& sample,
                         TechniqueCounts counts, LobeSet lobes, LiContext& context);

}  // namespace exphoton
