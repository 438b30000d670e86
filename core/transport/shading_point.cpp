// SPDX-License-Identifier: BSD-2-Clause
// MakeShadingPoint: evaluates the material of a hit.
#include "core/transport/shading_point.h"

namespace exphoton {

ShadingPoint MakeShadingPoint(const SurfaceInteraction& surface, const RayDifferential& ray,
                              int depth, TransportMode mode, Arena* arena) {
  SurfaceInteraction shaded = surface;
  const Material* material = surface.material;
  if (!material) return {shaded, Bsdf(shaded), ray, depth};
  if (ray.hasDifferentials && material->NeedsDifferentials()) shaded.ComputeDifferentials(ray);
  const Bsdf bsdf = material->Evaluate(&shaded, mode, arena);
  return {shaded, bsdf, ray, depth, Spectrum(1), surface.shading.n};
}

}  // namespace exphoton
