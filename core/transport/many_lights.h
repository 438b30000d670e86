// SPDX-License-Identifier: BSD-2-Clause
// ManyLights: light that reaches a surface straight from the lights, where they are too many to
// sample each: a few are chosen by the light tree for every point, and BSDF samples may meet any.
// Both are combined with the power heuristic for several samples of each (Veach 1997, eq. 9.13).
// The cost of a point does not depend on the number of lights, but for the logarithm in the tree.
#pragma once

#include <unordered_map>

#include "core/lights/light_tree.h"
#include "core/transport/integrator.h"
#include "core/transport/shading_point.h"

namespace exphoton {

class ManyLights {
 public:
  // Asks for `count` samples of lights at a shading point.
  void RequestSamples(const Scene& scene, const Sampler& sampler, int count, SampleLayout* layout);
  // Non-specular lobes only; 0 for a surface that has none.
  Spectrum Estimate(const ShadingPoint& point, LiContext& context) const;

 private:
  Spectrum FromBsdf(const ShadingPoint& point, Point2 u, Real uLobe, LiContext& context) const;
  // Density per solid angle of one light sample making wi by that light.
  Real LightPdf(const ShadingPoint& point, const Light& light, const Vector3& wi,
                const SurfacePoint* on) const;

  LightTree tree_;
  std::unordered_map<const Light*, int> indices_;
  int lightCount_ = 0, bsdfCount_ = 0;
  int choice1D_ = -1, part1D_ = -1, light2D_ = -1, bsdf2D_ = -1, lobe1D_ = -1;
};

}  // namespace exphoton
