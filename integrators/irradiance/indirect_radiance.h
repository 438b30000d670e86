// SPDX-License-Identifier: BSD-2-Clause
// IndirectRadiance estimates the light that reaches a surface from other surfaces, by path tracing
// with next event estimation. Light that comes straight from a light is left out, since direct
// lighting computes it.
#pragma once

#include "core/lights/selection/light_selection.h"
#include "core/transport/integrator.h"
#include "core/transport/shading_point.h"

namespace exphoton {

class IndirectRadiance {
 public:
  IndirectRadiance() = default;  // returns 0
  // Light is collected at the first maxDepth surfaces that a ray meets. The scene must outlive this
  // object.
  IndirectRadiance(const Scene& scene, int maxDepth);

  // Returns whether any required feature needs this light.
  bool IsNeeded() const { return maxDepth_ > 0 && (hasIndirect_ || hasCaustics_); }

  const LightSampler* Lights() const { return lights_.get(); }  // null: it has no scene

  struct Incident {
    Spectrum radiance;
    Real distance = kInfinity;  // to the first surface
  };
  // The ray left a surface by a non-specular lobe; its direction has length 1.
  Incident Along(const Ray& ray, RandomStream* random, LiContext& context) const;

 private:
  struct State;
  Spectrum Emission(const State& path, const SurfaceInteraction* hit, const Scene& scene) const;
  Spectrum Direct(const ShadingPoint& point, RandomStream* random, LiContext& context) const;
  bool Continue(const ShadingPoint& point, RandomStream* random, State* path) const;

  int maxDepth_ = 0;
  bool hasIndirect_ = false, hasCaustics_ = false;
  LobeSet lobes_ = LobeSet::All;  // of f, Pdf and Sample
  std::unique_ptr<const LightSampler> lights_;
};

}  // namespace exphoton
