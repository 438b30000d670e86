// SPDX-License-Identifier: BSD-2-Clause
// March integrates transmittance times a source term along a ray by ray marching, with one point
// per step, all at the same random offset. Transmittance is exact, so the estimate is unbiased.
#pragma once

#include "core/plugin.h"
#include "core/transport/volume_integrator.h"

namespace exphoton {

struct MarchSettings {
  Real stepSize = 1;
};

inline const ParamTable<MarchSettings>& MarchParameters() {
  static const ParamTable<MarchSettings> table{
      Param("stepsize", &MarchSettings::stepSize, "length of a step of ray marching")
          .Above(0)
          .Unit("scene units")};
  return table;
}

// source(p) returns the radiance added at p per unit length. ray.d has unit length.
template <class Source>
Spectrum March(const Ray& ray, const Scene& scene, Real stepSize, Real offset,
               const Source& source) {
  constexpr double kMaxSteps = 4096;  // beyond this, steps get longer; still unbiased
  Interval part{kInfinity, 0};
  for (const auto& medium : scene.Media()) {
    const auto overlap = medium->Overlap(ray);
    if (!overlap) continue;
    part = {std::min(part.min, overlap->min), std::max(part.max, overlap->max)};
  }
  if (!(part.max > part.min)) return {};
  const double length = double(part.max) - double(part.min);
  const int steps = int(std::clamp(std::ceil(length / double(stepSize)), 1.0, kMaxSteps));
  const double step = length / steps;
  Spectrum sum, depth;
  Real last = part.min;
  for (int i = 0; i < steps; ++i) {
    const Real t = Real(double(part.min) + (i + double(offset)) * step);
    for (const auto& medium : scene.Media()) depth += medium->OpticalDepth(ray, {last, t});
    last = t;
    const Spectrum transmittance = Exp(depth * Real(-1));
    if (!transmittance.IsBlack()) sum += transmittance * source(ray(t));
  }
  return sum * Real(step);
}

}  // namespace exphoton
