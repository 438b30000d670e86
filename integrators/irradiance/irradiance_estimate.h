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

// The place of an estimate. n is a unit normal of the surface's shading frame. Rays that would
// start behind ng are reversed, so that diffuse lobes scatter by the absolute cosine, as in Bsdf.
struct IrradianceQuery {
  const SurfacePoint& surface;
  Normal3 n;
  int rays;  // number to trace, approximately; at least 1 is traced
};

IrradianceEstimate EstimateIrradiance(const IrradianceQuery& query,
                                      const IndirectRadiance& incident, RandomStream random,
                                      LiContext& context);

}  // namespace exphoton
