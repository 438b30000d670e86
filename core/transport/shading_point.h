// SPDX-License-Identifier: BSD-2-Clause
// ShadingPoint is a hit with its BSDF. Emission, direct lighting, final gathering and specular
// bounces take it as input.
#pragma once

#include "core/geometry/interaction.h"
#include "core/lights/light.h"
#include "core/lights/selection/light_receiver.h"
#include "core/scattering/bsdf.h"
#include "core/scattering/material.h"

namespace exphoton {

struct ShadingPoint {
  SurfaceInteraction surface;
  Bsdf bsdf;
  RayDifferential ray;     // the ray that hit the surface
  int depth = 0;           // number of specular bounces since the camera
  Spectrum throughput{1};  // of the path to the camera; known to SpecularTree only
  // The interpolated normal, without bumps. It has unit length and lies on ng's side.
  Normal3 smooth = surface.shading.n;

  const Vector3& Wo() const { return surface.wo; }
  // Returns the radiance that the surface emits towards the ray's origin.
  Spectrum Le() const {
    if (!surface.areaLight) return {};
    return surface.areaLight->L(surface, surface.uv, surface.wo);
  }
  // Returns the place that lights are chosen for. A surface that only reflects receives light on
  // the side that the ray came from.
  LightReceiver Receiver() const {
    const bool isOneSided = !bsdf.Has(LobeSet::NonSpecularTransmission);
    return {surface.p, isOneSided ? FaceForward(bsdf.Ng(), Wo()) : Normal3(), bsdf.Ns()};
  }
};

// Evaluates the material at a hit. Ray differentials are computed only if the material needs them.
ShadingPoint MakeShadingPoint(const SurfaceInteraction& surface, const RayDifferential& ray,
                              int depth, TransportMode mode, Arena* arena);

}  // namespace exphoton
