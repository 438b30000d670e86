// SPDX-License-Identifier: BSD-2-Clause
// ShadingPoint: a hit with its BSDF, ready to be shaded. What Le, direct lighting, gathering and
// specular bounces all take.
#pragma once

#include "core/geometry/interaction.h"
#include "core/lights/light.h"
#include "core/scattering/bsdf.h"
#include "core/scattering/material.h"

namespace exphoton {

struct ShadingPoint {
  SurfaceInteraction surface;
  Bsdf bsdf;
  RayDifferential ray;  // that hit it
  int depth = 0;        // specular bounces between the camera and here

  const Vector3& Wo() const { return surface.wo; }
  // Radiance that the surface itself emits towards the ray's origin.
  Spectrum Le() const {
    if (!surface.areaLight) return {};
    return surface.areaLight->L(surface, surface.uv, surface.wo);
  }
};

// Evaluates the material at a hit. Ray differentials are computed only if the material asks.
ShadingPoint MakeShadingPoint(const SurfaceInteraction& surface, const RayDifferential& ray,
                              int depth, TransportMode mode, Arena* arena);

}  // namespace exphoton
