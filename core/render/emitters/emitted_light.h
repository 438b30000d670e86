// SPDX-License-Identifier: BSD-2-Clause
// EmittedLight is the light that a set of emitters sends along one camera ray, directly and over
// specular surfaces. LightAlong finds it with a specular tree whose surfaces have no other light.
#pragma once

#include "core/transport/specular/specular_tree.h"

namespace exphoton {

struct EmittedLight {
  Spectrum first, specular;         // from the first surface, and over specular surfaces
  bool isNear = false;              // whether a ray of the tree meets the bounds of the emitters
  const AreaLight* lamp = nullptr;  // the lamp of `first`; null: none

  bool HasSameColors(const EmittedLight& other) const {
    return first == other.first && specular == other.specular;
  }
  void Add(const EmittedLight& other, Real weight) {
    first += other.first * weight;
    specular += other.specular * weight;
  }
};

// EmissionShade is the light of the surfaces of a specular tree. It keeps the emission of the first
// surface apart.
template <class Emitters>
class EmissionShade {
 public:
  EmissionShade(const Emitters& emitters, const Scene& scene, EmittedLight* light)
      : emitters_(emitters), scene_(scene), light_(light) {}

  void See(const Ray& ray) const { light_->isNear = light_->isNear || emitters_.MayMeet(ray); }
  Spectrum operator()(const ShadingPoint& point) const {
    const Spectrum emission = point.Le();
    if (emission.IsBlack() || !emitters_.Contain(point.surface)) return {};
    if (point.depth > 0) return emission;
    Ray toPoint = point.ray;
    toPoint.tMax = Distance(toPoint.o, point.surface.p) / Length(toPoint.d);
    light_->first = emission * scene_.Transmittance(toPoint);
    light_->lamp = point.surface.areaLight;
    return {};
  }

 private:
  const Emitters& emitters_;
  const Scene& scene_;
  EmittedLight* light_;
};

// Traces the ray, and specular rays that follow from it, up to `depth` bounces. The random numbers
// of the tree are those of `sample`, so the light equals the emission in the result of an
// integrator with this SurfaceIntegrator::EmissionDepth. `rays` counts the rays. Emitters has
//   bool MayMeet(const Ray&) const                 whether the ray may hit one of the emitters
//   bool Contain(const SurfaceInteraction&) const  whether the point, which emits, is on one
template <class Emitters>
EmittedLight LightAlong(const RayDifferential& ray, const Emitters& emitters, int depth,
                        const LiContext& sample, RayCounters* rays) {
  RayCounters counters;  // the light that depth limits cut was measured for the sample itself
  LiContext context{sample.scene, sample.samples, sample.arena, counters, sample.key};
  const Arena::Mark mark = context.arena.GetMark();
  EmittedLight light;
  light.specular =
      SpecularTree(depth, context).Radiance(ray, EmissionShade(emitters, sample.scene, &light));
  context.arena.Rewind(mark);
  for (std::size_t i = 0; i < counters.counts.size(); ++i) rays->counts[i] += counters.counts[i];
  return light;
}

}  // namespace exphoton
