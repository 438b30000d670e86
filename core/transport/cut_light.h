// SPDX-License-Identifier: BSD-2-Clause
// These functions estimate the light that a path tracer leaves out at its depth limit, so that the
// renderer can warn. A few paths are continued beyond the limit, and their light goes into
// RayCounters instead of the picture.
#pragma once

#include "core/lights/selection/light_selection.h"
#include "core/transport/integrator.h"
#include "core/transport/shading_point.h"

namespace exphoton {

// One path in this number is measured, and counts as this number of paths.
inline constexpr int kCutLightPeriod = 32;

// Returns whether the path with this key is measured.
inline bool IsCutLightMeasured(std::uint64_t key) {
  return HashKey({key, 0x6375746cull}) % kCutLightPeriod == 0;
}

// The last vertex of a path within the depth limit.
struct PathEnd {
  const ShadingPoint& point;
  Spectrum beta;     // throughput up to the point
  bool isScattered;  // whether the path has a non-specular bounce before the point
};

// Returns an estimate of the light that longer paths carry. The integrator itself must collect the
// media and the emission that a non-specular bounce at the point finds. The random numbers are
// separate from the path's own, and the context is as before, except for the ray counts.
Spectrum LightBeyond(const PathEnd& end, const LightSampler& lights, LiContext& context);

// Adds the light beyond the end of a camera path to the cut light, if the sample is measured.
inline void MeasureCutLight(const PathEnd& end, const LightSampler& lights, LiContext& context) {
  if (!IsCutLightMeasured(context.key)) [[likely]]
    return;
  const double light = kCutLightPeriod * double(LightBeyond(end, lights, context).Y());
  context.rays.cutLight += light;
  context.rays.cutLightSquares += light * light;
}

}  // namespace exphoton
