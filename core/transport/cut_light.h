// SPDX-License-Identifier: BSD-2-Clause
// These functions estimate the light that a path tracer leaves out at its depth limit, so that the
// renderer can warn. A few paths are continued beyond the limit, and their light goes into
// RayCounters instead of the picture.
#pragma once

#include <algorithm>
#include <cstdint>
#include <memory>

#include "core/lights/selection/light_selection.h"
#include "core/transport/integrator.h"
#include "core/transport/shading_point.h"

namespace exphoton {

// Returns whether a path is among those that are measured, which are one in `period`.
inline bool IsCutLightMeasured(std::uint64_t key, std::uint64_t period) {
  return HashKey({key, 0x6375746cull}) % period == 0;
}

// Returns the period for the next sample of each pixel, given the number of earlier camera samples
// in the picture and of its pixels. Small pictures need all their paths: bright light that few
// paths find may be most of the cut light. Large ones need a share only. From 2^20 samples on, one
// path in 32 is measured.
inline std::uint64_t CutLightPeriod(double samplesBefore, double pixels) {
  constexpr double kFullyMeasured = 1 << 15, kLongest = 32;
  return std::uint64_t(std::clamp((samplesBefore + pixels) / kFullyMeasured, 1., kLongest));
}

// Returns the lights for an integrator that measures cut light alone with them. Null: the scene has
// no specular surface, so that nothing is cut.
inline std::unique_ptr<const LightSampler> MakeCutLightSampler(const Scene& scene) {
  if (!scene.Features().Needs(Feature::Specular)) return nullptr;
  return scene.MakeLightSampler(LightSelection::Auto);
}

// The last vertex of a path within the depth limit.
struct PathEnd {
  const ShadingPoint& point;
  Spectrum beta;                 // throughput up to the point
  bool isScattered;              // whether the path has a non-specular bounce before the point
  LobeSet lobes = LobeSet::All;  // that the depth limit cuts at the point
};

// Returns an estimate of the light that longer paths carry. The integrator itself must collect the
// media and the emission that a non-specular bounce at the point finds. The random numbers are
// separate from the path's own, and the context is as before. Its rays are not counted.
Spectrum LightBeyond(const PathEnd& end, const LightSampler& lights, LiContext& context);

// Adds the light beyond the end of a camera path to the cut light, if the sample is measured. A
// sample may have several ends.
inline void MeasureCutLight(const PathEnd& end, const LightSampler& lights, LiContext& context) {
  if (context.measuresCutLight) context.cutLight += double(LightBeyond(end, lights, context).Y());
}

}  // namespace exphoton
