// SPDX-License-Identifier: BSD-2-Clause
// Following gather rays through specular surfaces to what they read.
#include "integrators/photon/gather_radiance.h"

#include "core/transport/direct_lighting.h"

namespace exphoton {
namespace {

struct SpecularChoice {
  Vector3 wi;
  Spectrum throughput;
};

// One specular lobe, reflection or transmission, picked in proportion to what it carries.
std::optional<SpecularChoice> FollowSpecular(const ShadingPoint& point, RandomStream* random) {
  const Point2 u{random->Uniform(), random->Uniform()};
  const Real uLobe = random->Uniform(), uSide = random->Uniform();
  const auto reflected = point.bsdf.Sample(point.Wo(), u, uLobe, LobeSet::SpecularReflection);
  const auto refracted = point.bsdf.Sample(point.Wo(), u, uLobe, LobeSet::SpecularTransmission);
  const Real r = reflected ? reflected->throughput.Y() : Real(0);
  const Real t = refracted ? refracted->throughput.Y() : Real(0);
  if (!(r + t > 0)) return std::nullopt;
  const Real reflectProbability = r / (r + t);
  if (uSide < reflectProbability)
    return SpecularChoice{reflected->wi, reflected->throughput / reflectProbability};
  return SpecularChoice{refracted->wi, refracted->throughput / (1 - reflectProbability)};
}

}  // namespace

Spectrum GatherRadiance::Along(RayDifferential ray, LiContext& context, RandomStream* random,
                               int shortBounces) const {
  const bool followsSpecular = context.scene.Effects().Needs(Effect::Specular);
  Spectrum sum, throughput(1);
  for (int depth = 0;; ++depth) {
    const auto hit = context.IntersectPoint(ray, RayKind::Gather);
    if (!hit || !hit->material) return sum;
    sum += throughput * NonSpecular(*hit, ray, context, random, shortBounces);
    if (!followsSpecular || !Intersects(hit->material->PossibleLobes(), LobeSet::Specular))
      return sum;
    const Arena::Mark mark = context.arena.GetMark();
    const ShadingPoint point = Shade(*hit, ray, context);
    if (depth == settings_.maxDepth) {
      context.rays.cutGatherThroughput +=
          double((throughput * point.bsdf.Rho(LobeSet::Specular)).Y());
      context.arena.Rewind(mark);
      return sum;
    }
    const auto bounce = FollowSpecular(point, random);
    context.arena.Rewind(mark);
    if (!bounce) return sum;
    throughput *= bounce->throughput;
    ray = SpawnRay(hit->point, bounce->wi, ray.time);
  }
}

ShadingPoint GatherRadiance::Shade(const Scene::HitPoint& hit, const RayDifferential& ray,
                                   LiContext& context) const {
  return MakeShadingPoint(context.scene.Complete(ray, hit.hit), ray, 0, TransportMode::Radiance,
                          &context.arena);
}

Spectrum GatherRadiance::NonSpecular(const Scene::HitPoint& hit, const RayDifferential& ray,
                                     LiContext& context, RandomStream* random,
                                     int shortBounces) const {
  if (!Intersects(hit.material->PossibleLobes(), LobeSet::NonSpecular)) return {};
  bool isShort = false;
  if (radianceMap_) {
    const Normal3 n = FaceForward(hit.point.ng, -ray.d);
    const RadianceMap::Entry* entry = radianceMap_->Find(hit.point.p, n);
    isShort =
        entry && DistanceSquared(ray.o, hit.point.p) < Square(settings_.shortRays * entry->radius);
    if (entry && !isShort) {
      if (context.layers) {
        context.layers->radianceDistance += double(radianceMap_->DistanceTo(*entry, hit.point.p));
        ++context.layers->radiancePhotonsRead;
      }
      if (settings_.radianceMode == RadianceMode::Exitant) return entry->value;
      return Reflected(hit, ray, *entry, context);
    }
  }
  const Arena::Mark mark = context.arena.GetMark();
  const ShadingPoint point = Shade(hit, ray, context);
  const bool goesOn =
      isShort && settings_.shortGather == ShortGather::Gather && shortBounces < kMaxShortBounces;
  const Spectrum radiance = goesOn ? OneMoreBounce(point, context, random, shortBounces)
                                   : maps_.Radiance(point, &context.arena);
  context.arena.Rewind(mark);
  return radiance;
}

Spectrum GatherRadiance::Reflected(const Scene::HitPoint& hit, const RayDifferential& ray,
                                   const RadianceMap::Entry& front, LiContext& context) const {
  const Arena::Mark mark = context.arena.GetMark();
  const ShadingPoint point = Shade(hit, ray, context);
  Spectrum radiance = point.bsdf.Rho(LobeSet::NonSpecularReflection) * front.value * kInvPi;
  const Spectrum transmittance = context.scene.Effects().Needs(Effect::Transmission)
                                     ? point.bsdf.Rho(LobeSet::NonSpecularTransmission)
                                     : Spectrum();
  if (!transmittance.IsBlack()) {
    const Normal3 back = -FaceForward(hit.point.ng, -ray.d);
    const RadianceMap::Entry* entry = radianceMap_->Find(hit.point.p, back);
    const Spectrum e =
        entry ? entry->value : maps_.EstimateIrradiance(hit.point.p, back, &context.arena).e;
    radiance += transmittance * e * kInvPi;
  }
  context.arena.Rewind(mark);
  return radiance;
}

Spectrum GatherRadiance::OneMoreBounce(const ShadingPoint& point, LiContext& context,
                                       RandomStream* random, int shortBounces) const {
  Spectrum sum = maps_.Radiance(PhotonKind::Caustic, point, &context.arena);
  if (!lights_.IsEmpty()) {
    const auto choice = lights_.Sample(random->Uniform());
    DirectLightSample sample;
    sample.light = {random->Uniform(), random->Uniform()};
    sample.lightPart = random->Uniform();
    sample.bsdf = {random->Uniform(), random->Uniform()};
    sample.bsdfLobe = random->Uniform();
    sum += EstimateDirect(point, *choice.light, sample, context) / choice.probability;
  }
  const Point2 u{random->Uniform(), random->Uniform()};
  if (const auto bounce = point.bsdf.Sample(point.Wo(), u, random->Uniform(), LobeSet::NonSpecular))
    sum += bounce->throughput *
           Along(SpawnRay(point.surface, bounce->wi), context, random, shortBounces + 1);
  return sum;
}

}  // namespace exphoton
