// SPDX-License-Identifier: BSD-2-Clause
// Scene: geometry, lights and the plan of effects; what integrators see. Immutable once made; no
// globals, so many scenes can live in one process.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "core/base/error.h"
#include "core/lights/light.h"
#include "core/scattering/material.h"
#include "core/scattering/medium.h"
#include "core/scene/aggregate.h"
#include "core/scene/primitive.h"
#include "core/scene/required_features.h"

namespace exphoton {

class Camera;

// Where a light comes from, for what people are told of it; empty where nobody said so.
struct LightOrigin {
  std::string plugin;  // "spot"
  std::optional<SourceLocation> where;
};

// Everything a scene is made of; the scene takes it over.
struct SceneParts {
  std::unique_ptr<PrimitiveSet> primitives;
  std::unique_ptr<Aggregate> aggregate;  // over *primitives
  std::vector<std::unique_ptr<ObjectGeometry>> objects;
  std::vector<std::unique_ptr<Light>> lights;
  std::vector<LightOrigin> lightOrigins;  // of lights, in their order; may be shorter
  std::vector<std::shared_ptr<const Material>> materials;       // used by any primitive
  std::vector<std::shared_ptr<const EmitterSurface>> emitters;  // referred to by area lights
  std::vector<std::unique_ptr<Medium>> media;
};

class Scene {
 public:
  explicit Scene(SceneParts parts);  // prepares the lights
  ~Scene();

  std::optional<SurfaceInteraction> Intersect(const RayDifferential& ray) const;
  // The nearest hit and where it lies, for rays that may need no more; Complete gives the rest.
  struct HitPoint {
    Hit hit;
    SurfacePoint point;
    const Material* material;
    const Motion* motion;  // null: the surface rests
  };
  std::optional<HitPoint> IntersectPoint(const Ray& ray) const;
  SurfaceInteraction Complete(const Ray& ray, const Hit& hit) const;
  bool Occluded(const Ray& ray) const { return aggregate_->Occluded(ray); }

  // Radiance of every infinite light along a ray that escaped in direction w.
  Spectrum EscapedRadiance(const Vector3& w) const;

  // All lights in the order of the file. Black ones are kept, so that indices are stable; skip
  // them.
  const std::vector<std::unique_ptr<Light>>& Lights() const { return parts_.lights; }
  int ShiningLights() const;  // how many are not black
  const LightOrigin& OriginOfLight(std::size_t i) const { return parts_.lightOrigins[i]; }
  const std::vector<const Light*>& InfiniteLights() const { return infiniteLights_; }
  const std::vector<std::shared_ptr<const Material>>& Materials() const { return parts_.materials; }
  const Bounds3& WorldBounds() const { return bounds_; }
  const PrimitiveSet& Primitives() const { return *parts_.primitives; }
  const Aggregate& Accelerator() const { return *aggregate_; }

  const RequiredFeatures& Features() const { return effects_; }
  // Before anything refers to lights: without Feature::Environment infinite lights are taken out.
  // shutter: when it opens and closes; without Feature::Motion all happens as it opens.
  void SetFeatures(RequiredFeatures plan, Interval shutter = {0, 0});
  // The times of all rays: photons spread over them, as camera rays do.
  Interval Exposure() const { return exposure_; }

  // Empty where the plan of effects leaves media out.
  const std::vector<std::unique_ptr<Medium>>& Media() const { return parts_.media; }
  bool HasMedia() const {
    return RequiredFeatures::IsCompiled(Feature::Media) && !parts_.media.empty();
  }
  // What part of the light gets through all media, over 0 < t < ray.tMax.
  Spectrum Transmittance(const Ray& ray) const {
    return HasMedia() ? TransmittanceOfMedia(ray) : Spectrum(1);
  }

 private:
  Spectrum TransmittanceOfMedia(const Ray& ray) const;

  SceneParts parts_;
  const Aggregate* aggregate_;
  Bounds3 bounds_;
  std::vector<const Light*> infiniteLights_;
  RequiredFeatures effects_;
  Interval exposure_{0, 0};
};

// The plan for this scene and camera (effects.md's table): decides from materials, lights, camera.
RequiredFeatures PlanFeatures(const Scene& scene, const Camera& camera);
// Adds to a plan at which times camera rays and photons are shot, if anything ever moves.
void NoteTimes(const Scene& scene, const Camera& camera, RequiredFeatures* plan);

}  // namespace exphoton
