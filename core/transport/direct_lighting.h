// SPDX-License-Identifier: BSD-2-Clause
// DirectLighting: light that reaches a surface straight from the lights, by shadow rays and BSDF
// samples combined with the power heuristic (Veach 1997, chapter 9). Serves every integrator.
#pragma once

#include <limits>
#include <optional>
#include <vector>

#include "core/transport/integrator.h"
#include "core/transport/many_lights.h"
#include "core/transport/shading_point.h"

namespace exphoton {

// The random numbers of one estimate.
struct DirectLightingVariates {
  Point2 light;        // point on the light
  Real lightPart = 0;  // part of the light
  Point2 bsdf;         // direction
  Real bsdfLobe = 0;
};

// One light's contribution to the non-specular lobes, one light sample and one BSDF sample.
// Delta lights take no BSDF sample. Black lights give 0 without a ray.
Spectrum EstimateDirect(const ShadingPoint& point, const Light& light,
                        const DirectLightingVariates& sample, LiContext& context);

// Sums over all lights, each with its own number of samples, from arrays of the sampler. Where more
// than mostLights are not black, so many samples of lights chosen by a tree stand for the sum.
class DirectLighting {
 public:
  explicit DirectLighting(int mostLights = std::numeric_limits<int>::max())
      : mostLights_(mostLights) {}

  void RequestSamples(const Scene& scene, const Sampler& sampler, SampleLayout* layout);
  // Non-specular lobes only; 0 for a surface that has none.
  Spectrum AllLights(const ShadingPoint& point, LiContext& context) const;

 private:
  struct LightArrays {
    int count = 0;  // samples of this light, at least its SampleCount()
    int light2D = -1, part1D = -1, bsdf2D = -1, lobe1D = -1;
  };
  int mostLights_;
  std::vector<LightArrays> arrays_;  // one a light; count 0 for black lights
  std::optional<ManyLights> many_;   // instead of the arrays
};

}  // namespace exphoton
