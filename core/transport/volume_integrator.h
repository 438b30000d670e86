// SPDX-License-Identifier: BSD-2-Clause
// VolumeIntegrator: the interface of light that media add along a ray (plugins), and AlongMedia,
// by which surface integrators ask what media do to a ray. Scenes without media pay one comparison.
#pragma once

#include "core/transport/integrator.h"

namespace exphoton {

class VolumeIntegrator {
 public:
  virtual ~VolumeIntegrator() = default;

  virtual void Preprocess(const Scene& scene) { (void)scene; }
  // Whether Li includes light that comes straight from a light and is scattered once.
  virtual bool ScattersLight() const { return false; }
  // Radiance that the scene's media send along the ray to its origin from 0 < t < ray.tMax, what
  // they absorb on the way taken off. ray.d is unit. `random`: of this stretch alone.
  virtual Spectrum Li(const Ray& ray, LiContext& context, RandomStream random) const = 0;
};

// What media do to a ray: light from its end arrives times the transmittance, plus radiance.
struct MediaSegment {
  Spectrum transmittance{1}, radiance;
};

MediaSegment MarchMedia(const Ray& ray, const Point3* end, LiContext& context);

// `end`: where the ray ends; null: it escapes.
inline MediaSegment AlongMedia(const Ray& ray, const Point3* end, LiContext& context) {
  if (!context.scene.HasMedia()) [[likely]]
    return {};
  return MarchMedia(ray, end, context);
}

}  // namespace exphoton
