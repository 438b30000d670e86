// SPDX-License-Identifier: BSD-2-Clause
// CausticRays: the rays of a point, and the chain of specular surfaces that each follows.
#include "integrators/photon/certificate/caustic_rays.h"

#include <algorithm>

#include "core/transport/specular/specular_bounce.h"

namespace exphoton {
namespace {

// Ends the chains that Russian roulette cannot end, such as light inside a loss-free mirror box.
constexpr int kMostBounces = 100;

// Rays of a point, an even number.
constexpr int kCausticRays = 4;

bool IsSpecular(const std::optional<Scene::HitPoint>& hit) {
  return hit && hit->material && Intersects(hit->material->PossibleLobes(), LobeSet::Specular);
}

Spectrum TransmittanceTo(const std::optional<Scene::HitPoint>& hit, const Ray& ray,
                         const Scene& scene) {
  Ray segment = ray;
  if (hit) segment.tMax = Distance(ray.o, hit->point.p);
  return scene.Transmittance(segment);
}

// Returns the emission of the surface at the end of the ray, or of the lights around the scene.
Spectrum EmissionAt(const std::optional<Scene::HitPoint>& hit, const Ray& ray, const Scene& scene) {
  if (!hit) return scene.EscapedRadiance(ray.d);
  const AreaLight* const light = scene.Primitives().Attributes(hit->hit).areaLight;
  if (!light) return {};
  const SurfaceInteraction surface = scene.Complete(ray, hit->hit);
  return light->L(surface, surface.uv, surface.wo);
}

}  // namespace

bool CausticRaysFindAll(const Scene& scene) {
  if (!scene.Features().Needs(Feature::Caustics)) return false;
  return std::ranges::none_of(scene.Lights(), [](const auto& light) {
    return light->IsDelta() && !light->IsProvablyBlack();
  });
}

Spectrum CausticRays::Sample(const ShadingPoint& point, LobeSet lobes) {
  if (!point.bsdf.Has(lobes)) return {};
  const Arena::Mark mark = context_.arena.GetMark();
  Rays rays{{}, kCausticRays};
  if (guide_.IsOn()) rays.guide = {guide_.DirectionsOnPath(point, context_).axes, cone_};
  if (!rays.guide.IsEmpty()) rays.each = kCausticRays / 2;
  Spectrum sum;
  for (int i = 0; i < rays.each; ++i) {
    sum += ByBsdf(point, rays, lobes, i);
    if (!rays.guide.IsEmpty()) sum += ByGuide(point, rays, lobes, i);
  }
  context_.arena.Rewind(mark);
  return sum;
}

Spectrum CausticRays::ByBsdf(const ShadingPoint& point, const Rays& rays, LobeSet lobes,
                             int index) {
  const Point2 u{InStratum(index, rays.each), random_->Uniform()};
  const auto sample = point.bsdf.Sample(point.Wo(), u, random_->Uniform(), lobes);
  if (!sample) return {};
  const Spectrum weight = sample->throughput * (sample->pdf / rays.Pdf(sample->wi, sample->pdf));
  return weight * Along(SpawnRay(point.surface, sample->wi));
}

// The axes are in Hilbert order, so strata of them are strata of directions.
Spectrum CausticRays::ByGuide(const ShadingPoint& point, const Rays& rays, LobeSet lobes,
                              int index) {
  const Point2 u{random_->Uniform(), random_->Uniform()};
  const Vector3 wi = rays.guide.Draw(InStratum(index, rays.each), u).w;
  const BsdfValue scattered = point.bsdf.Evaluate(point.Wo(), wi, lobes);
  const Spectrum weight = scattered.f * (AbsDot(wi, point.bsdf.Ns()) / rays.Pdf(wi, scattered.pdf));
  if (weight.IsBlack() || !weight.IsFinite()) return {};
  return weight * Along(SpawnRay(point.surface, wi));
}

Real CausticRays::InStratum(int index, int count) {
  return std::min((Real(index) + random_->Uniform()) / Real(count), kOneMinusEpsilon);
}

Spectrum CausticRays::Along(Ray ray) {
  const Scene& scene = context_.scene;
  Spectrum throughput(1), emission;
  for (int bounces = 0; bounces < kMostBounces; ++bounces) {
    const auto hit = context_.IntersectPoint(ray, RayKind::Gather);
    if (bounces == 0 && !IsSpecular(hit)) break;
    throughput *= TransmittanceTo(hit, ray, scene);
    if (bounces > 0) emission += throughput * EmissionAt(hit, ray, scene);
    if (!IsSpecular(hit)) break;
    const ShadingPoint point = MakeShadingPoint(scene.Complete(ray, hit->hit), ray, 0,
                                                TransportMode::Radiance, &context_.arena);
    const Point2 u{random_->Uniform(), random_->Uniform()};
    const auto next = SampleSpecularRay(point, LobeSet::Specular, u, random_->Uniform());
    if (!next) break;
    throughput *= next->throughput;
    const Real survival = SpecularSurvival(throughput, 1);
    if (survival < 1 && !(random_->Uniform() < survival)) break;
    throughput /= survival;
    ray = next->ray;
  }
  return emission;
}

}  // namespace exphoton
