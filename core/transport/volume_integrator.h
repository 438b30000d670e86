// SPDX-License-Identifier: BSD-2-Clause
// VolumeIntegrator is the interface of algorithms for light that media add along a ray (plugins).
// AlongMedia applies the media to a ray of a surface integrator. It costs scenes without media one
// comparison.
#pragma once

#include "core/transport/integrator.h"

namespace exphoton {

class VolumeIntegrator {
 public:
  virtual ~VolumeIntegrator() = default;

  virtual void Preprocess(const Scene& scene) { (void)scene; }
  // Returns whether Li includes single scattering of direct light.
  virtual bool ScattersLight() const { return false; }
  // Returns the radiance that reaches the ray's origin from the media in 0 < t < ray.tMax,
  // attenuated by the media in between. ray.d has unit length. `random` belongs to this segment
  // alone.
  virtual Spectrum Li(const Ray& ray, LiContext& context, RandomStream random) const = 0;
};

// The effect of media on a ray: L_origin = transmittance * L_end + radiance.
struct MediaSegment {
  Spectrum transmittance{1}, radiance;
};

MediaSegment MarchMedia(const Ray& ray, const Point3* end, LiContext& context);

// `end` is the end of the ray; null if the ray escapes.
inline MediaSegment AlongMedia(const Ray& ray, const Point3* end, LiContext& context) {
  if (!context.scene.HasMedia()) [[likely]]
    return {};
  return MarchMedia(ray, end, context);
}

}  // namespace exphoton
