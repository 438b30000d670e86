// SPDX-License-Identifier: BSD-2-Clause
// DirectLighting estimates the direct light at a surface by next event estimation. It combines
// light samples and BSDF samples by the power heuristic (Veach 1997, chapter 9). All integrators
// use it.
#pragma once

#include <limits>
#include <optional>
#include <vector>

#include "core/transport/integrator.h"
#include "core/transport/many_lights.h"
#include "core/transport/shading_point.h"

namespace exphoton {

// The random numbers of one estimate, uniform in [0,1).
struct DirectLightingVariates {
  Point2 light;        // position on the light
  Real lightPart = 0;  // part of the light
  Point2 bsdf;         // BSDF direction
  Real bsdfLobe = 0;
};

// Estimates the contribution of one light to the non-specular lobes, with one light sample and one
// BSDF sample. Delta lights take no BSDF sample. Black lights return 0 without tracing a ray.
Spectrum EstimateDirect(const ShadingPoint& point, const Light& light,
                        const DirectLightingVariates& sample, LiContext& context);

// Sums the direct light of all lights; each light has its own number of samples from the sampler's
// arrays. If more than mostLights lights are not black, `chosen` light samples from the light tree
// estimate the sum instead (ManyLights).
class DirectLighting {
 public:
  // The numbers for users who choose none.
  static constexpr int kMostLights = 64, kChosenLights = 16;

  DirectLighting() = default;
  DirectLighting(int mostLights, int chosen) : mostLights_(mostLights), chosen_(chosen) {}

  void RequestSamples(const Scene& scene, const Sampler& sampler, SampleLayout* layout);
  // Covers the non-specular lobes only. Returns 0 for a surface without such lobes.
  Spectrum AllLights(const ShadingPoint& point, LiContext& context) const;

 private:
  struct LightArrays {
    int count = 0;  // samples of this light, at least its SampleCount()
    int light2D = -1, part1D = -1, bsdf2D = -1, lobe1D = -1;
  };
  int mostLights_ = std::numeric_limits<int>::max(), chosen_ = kChosenLights;
  std::vector<LightArrays> arrays_;  // per light; count is 0 for black lights
  std::optional<ManyLights> many_;   // replaces the arrays
};

}  // namespace exphoton
