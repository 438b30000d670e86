// SPDX-License-Identifier: BSD-2-Clause
// Scene: assembles the parts, prepares the lights and answers ray queries.
#include "core/scene/scene.h"

#include <algorithm>

namespace exphoton {

Scene::Scene(SceneParts parts)
    : parts_(std::move(parts)),
      aggregate_(parts_.aggregate.get()),
      bounds_(parts_.primitives->WorldBounds()) {
  parts_.lightOrigins.resize(parts_.lights.size());
  const Sphere3 world = BoundingSphere(bounds_);
  for (const auto& light : parts_.lights) {
    light->Prepare(world);
    if (light->IsInfinite() && !light->IsProvablyBlack()) infiniteLights_.push_back(light.get());
  }
}

Scene::~Scene() = default;

int Scene::NonBlackLightCount() const {
  return int(std::count_if(Lights().begin(), Lights().end(),
                           [](const auto& light) { return !light->IsProvablyBlack(); }));
}

std::unique_ptr<const LightSampler> Scene::MakeLightSampler(LightSelection selection) const {
  return exphoton::MakeLightSampler(Lights(), BoundingSphere(bounds_), selection);
}

void Scene::SetFeatures(RequiredFeatures plan, Interval shutter) {
  effects_ = std::move(plan);
  exposure_ = {shutter.min, effects_.Needs(Feature::Motion) ? shutter.max : shutter.min};
  if (!effects_.Needs(Feature::Media)) {
    const bool areEmpty =
        std::ranges::all_of(parts_.media, [](const auto& m) { return m->IsProvablyEmpty(); });
    isWhole_ = isWhole_ && areEmpty;
    hadEmptyMedia_ = hadEmptyMedia_ || (areEmpty && !parts_.media.empty());
    parts_.media.clear();
  }
  if (effects_.Needs(Feature::Environment)) return;
  isWhole_ = isWhole_ && infiniteLights_.empty();
  for (std::size_t i = parts_.lights.size(); i-- > 0;) {
    if (!parts_.lights[i]->IsInfinite()) continue;
    parts_.lights.erase(parts_.lights.begin() + std::ptrdiff_t(i));
    parts_.lightOrigins.erase(parts_.lightOrigins.begin() + std::ptrdiff_t(i));
  }
  infiniteLights_.clear();
}

std::optional<SurfaceInteraction> Scene::Intersect(const RayDifferential& ray) const {
  const Hit hit = aggregate_->Intersect(ray);
  if (!hit.IsHit()) return std::nullopt;
  return Complete(ray, hit);
}

std::optional<Scene::HitPoint> Scene::IntersectPoint(const Ray& ray) const {
  const Hit hit = aggregate_->Intersect(ray);
  if (!hit.IsHit()) return std::nullopt;
  const PrimitiveSet& primitives = *parts_.primitives;
  return HitPoint{hit, primitives.Point(ray, hit), primitives.Attributes(hit).material,
                  primitives.MotionOf(hit)};
}

SurfaceInteraction Scene::Complete(const Ray& ray, const Hit& hit) const {
  SurfaceInteraction surface = parts_.primitives->Surface(ray, hit);
  surface.wo = NormalizeOr(-ray.d, surface.ng);
  surface.time = ray.time;
  return surface;
}

Spectrum Scene::TransmittanceOfMedia(const Ray& ray) const {
  Spectrum depth;
  for (const auto& medium : parts_.media)
    if (const auto part = medium->Overlap(ray)) depth += medium->OpticalDepth(ray, *part);
  return Exp(depth * Real(-1));
}

Spectrum Scene::TransmittanceBefore(const Light& light, const Ray& ray) const {
  if (!HasMedia() || !light.IsDistant()) return Spectrum(1);
  Ray back = ray;
  back.d = -ray.d;
  back.tMax = kInfinity;
  return TransmittanceOfMedia(back);
}

Spectrum Scene::EscapedRadiance(const Vector3& w) const {
  Spectrum sum;
  if (!RequiredFeatures::IsCompiled(Feature::Environment)) return sum;
  for (const Light* light : infiniteLights_) sum += light->Le(w);
  return sum;
}

}  // namespace exphoton
