// SPDX-License-Identifier: BSD-2-Clause
// ManyLights estimates the direct light of more lights than can be sampled individually. For each
// shading point, the light tree chooses a few lights; BSDF samples may hit any light. The power
// heuristic for several samples per technique combines both (Veach 1997, eq. 9.13). The cost of a
// point grows only logarithmically with the number of lights.
#pragma once

#include <memory>

#include "core/lights/selection/light_sampler.h"
#include "core/transport/integrator.h"
#include "core/transport/shading_point.h"

namespace exphoton {

class ManyLights {
 public:
  // Requests `count` light samples per shading point.
  void RequestSamples(const Scene& scene, const Sampler& sampler, int count, SampleLayout* layout);
  // Covers the non-specular lobes only. Returns 0 for a surface without such lobes.
  Spectrum Estimate(const ShadingPoint& point, LiContext& context) const;

 private:
  // The random numbers of a BSDF sample, uniform in [0,1).
  struct BsdfVariates {
    Point2 direction;
    Real lobe;
  };
  // The receiver belongs to the point and is prepared.
  Spectrum FromBsdf(const ShadingPoint& point, const LightReceiver& receiver, const BsdfVariates& u,
                    LiContext& context) const;

  std::unique_ptr<const LightSampler> lights_;  // a light tree
  int lightCount_ = 0, bsdfCount_ = 0;
  int choice1D_ = -1, part1D_ = -1, light2D_ = -1, bsdf2D_ = -1, lobe1D_ = -1;
};

}  // namespace exphoton
