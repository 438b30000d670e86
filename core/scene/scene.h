// SPDX-License-Identifier: BSD-2-Clause
// Scene holds the geometry, the lights and the required features. Integrators see the scene through
// this class. It is immutable while it is rendered. It uses no globals, so several scenes can exist
// in one process.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "core/base/error.h"
#include "core/lights/light.h"
#include "core/lights/selection/light_selection.h"
#include "core/scattering/material.h"
#include "core/scattering/medium.h"
#include "core/scene/aggregate.h"
#include "core/scene/primitive.h"
#include "core/scene/required_features.h"

namespace exphoton {

class Camera;

// The origin of a light, for messages and listings. Empty if unknown.
struct LightOrigin {
  std::string plugin;  // for example "spot"
  std::optional<SourceLocation> where;
};

// The parts of a scene. The scene takes ownership.
struct SceneParts {
  std::unique_ptr<PrimitiveSet> primitives;
  std::unique_ptr<Aggregate> aggregate;  // over *primitives
  std::vector<std::unique_ptr<ObjectGeometry>> objects;
  std::vector<std::unique_ptr<Light>> lights;
  std::vector<LightOrigin> lightOrigins;                   // in the order of lights; may be shorter
  std::vector<std::shared_ptr<const Material>> materials;  // in the order of the shapes, also
                                                           // of objects without an instance
  std::vector<std::shared_ptr<const EmitterSurface>> emitters;  // referenced by area lights
  std::vector<std::unique_ptr<Medium>> media;
};

class Scene {
 public:
  explicit Scene(SceneParts parts);  // prepares the lights
  ~Scene();

  std::optional<SurfaceInteraction> Intersect(const RayDifferential& ray) const;
  // The nearest hit and its position, for rays that may need nothing else. Complete computes the
  // full surface record.
  struct HitPoint {
    Hit hit;
    SurfacePoint point;
    const Material* material;
    const Motion* motion;  // null: the surface does not move
  };
  std::optional<HitPoint> IntersectPoint(const Ray& ray) const;
  SurfaceInteraction Complete(const Ray& ray, const Hit& hit) const;
  bool Occluded(const Ray& ray) const { return aggregate_->Occluded(ray); }

  // Returns the radiance of all infinite lights along an escaped ray of direction w.
  Spectrum EscapedRadiance(const Vector3& w) const;

  // All lights, in the order of the file. Black lights are kept so that indices are stable. Callers
  // must skip them.
  const std::vector<std::unique_ptr<Light>>& Lights() const { return parts_.lights; }
  int NonBlackLightCount() const;  // number of lights that are not black
  // The scene must outlive the sampler.
  std::unique_ptr<const LightSampler> MakeLightSampler(LightSelection selection) const;
  const LightOrigin& OriginOfLight(std::size_t i) const { return parts_.lightOrigins[i]; }
  const std::vector<const Light*>& InfiniteLights() const { return infiniteLights_; }
  const std::vector<std::shared_ptr<const Material>>& Materials() const { return parts_.materials; }
  const Bounds3& WorldBounds() const { return bounds_; }
  const PrimitiveSet& Primitives() const { return *parts_.primitives; }
  const Aggregate& Accelerator() const { return *aggregate_; }

  const RequiredFeatures& Features() const { return effects_; }
  // Must be called before other objects refer to lights, because it removes infinite lights if
  // Feature::Environment is off. `shutter` is the shutter interval. If Feature::Motion is off, all
  // rays use the time at which the shutter opens.
  void SetFeatures(RequiredFeatures plan, Interval shutter = {0, 0});
  // Returns whether SetFeatures has removed nothing so far, so that any features can follow.
  bool IsWhole() const { return isWhole_; }
  // Returns whether it has removed media that are provably empty.
  bool HadEmptyMedia() const { return hadEmptyMedia_; }
  // The time interval of camera rays and photons.
  Interval Exposure() const { return exposure_; }

  // Empty if Feature::Media is off.
  const std::vector<std::unique_ptr<Medium>>& Media() const { return parts_.media; }
  bool HasMedia() const {
    return RequiredFeatures::IsCompiled(Feature::Media) && !parts_.media.empty();
  }
  // Returns the transmittance of all media over 0 < t < ray.tMax.
  Spectrum Transmittance(const Ray& ray) const {
    return HasMedia() ? TransmittanceOfMedia(ray) : Spectrum(1);
  }
  // Returns the transmittance of all media between infinity and the origin of a ray that a light
  // emits. It is 1 if the light is not at infinity. Rays of lights at infinity start near the
  // surfaces, and media may reach farther than these.
  Spectrum TransmittanceBefore(const Light& light, const Ray& ray) const;

 private:
  Spectrum TransmittanceOfMedia(const Ray& ray) const;

  SceneParts parts_;
  const Aggregate* aggregate_;
  Bounds3 bounds_;
  std::vector<const Light*> infiniteLights_;
  bool isWhole_ = true, hadEmptyMedia_ = false;
  RequiredFeatures effects_;
  Interval exposure_{0, 0};
};

// Derives the required features from the materials, the lights and the camera.
// docs/guide/effects.md lists the rules.
RequiredFeatures FindRequiredFeatures(const Scene& scene, const Camera& camera);
// Adds a note with the times of camera rays and photons, if anything in the scene ever moves.
void NoteTimes(const Scene& scene, const Camera& camera, RequiredFeatures* plan);

}  // namespace exphoton
