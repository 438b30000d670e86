// SPDX-License-Identifier: BSD-2-Clause
// EstimateIrradiance integrates the indirect light over the hemisphere with stratified rays, and
// computes the gradients of the result for a move and for a turn of the surface. Source: Ward and
// Heckbert 1992, "Irradiance Gradients".
#pragma once

#include "integrators/irradiance/indirect_radiance.h"
#include "integrators/irradiance/irradiance_cache.h"

namespace exphoton {

struct IrradianceEstimate {
  Spectrum irradiance;                           // W/m^2
  std::array<Vector3, 3> translation, rotation;  // as in IrradianceRecord
  Real meanDistance = kInfinity;                 // harmonic mean of the rays' lengths
};

// n is a unit normal of the surface's shading frame; rays that would start behind ng carry nothing.
// About `rays` rays are traced, at least 1.
IrradianceEstimate EstimateIrradiance(const SurfacePoint& surface, const Normal3& n, int rays,
                                      const IndirectRadiance& incident, RandomStream random,
                                      LiContext& context);

}  // namespace exphoton
