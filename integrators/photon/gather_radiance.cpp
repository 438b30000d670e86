// SPDX-License-Identifier: BSD-2-Clause
// Following gather rays through specular surfaces to what they read.
#include "integrators/photon/gather_radiance.h"

#include "core/transport/direct_lighting.h"
#include "core/transport/volume_integrator.h"
#include "integrators/photon/rest_pose.h"

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

RestPose PoseOf(const Scene::HitPoint& hit) { return {hit.motion, hit.point.time}; }

}  // namespace

void GatherRadiance::Look(std::span<Segment> segments) const {
  if (!radianceMap_) return;
  constexpr std::size_t kAtOnce = 16;
  RadianceMap::Place places[kAtOnce];
  Segment* of[kAtOnce];
  std::optional<RadianceMap::Entry> found[kAtOnce];
  std::size_t count = 0;
  const auto look = [&] {
    radianceMap_->Find({places, count}, found);
    for (std::size_t i = 0; i < count; ++i) of[i]->entry = found[i];
    count = 0;
  };
  for (Segment& segment : segments) {
    if (!segment.hit || !segment.hit->material) continue;
    if (!Intersects(segment.hit->material->PossibleLobes(), LobeSet::NonSpecular)) continue;
    const SurfacePoint& point = segment.hit->point;
    const RestPose rest = PoseOf(*segment.hit);
    places[count] = {rest.Point(point.p), rest.Normal(FaceForward(point.ng, -segment.ray.d))};
    of[count++] = &segment;
    if (count == kAtOnce) look();
  }
  look();
}

Spectrum GatherRadiance::Along(Segment segment, int shortBounces) const {
  const bool followsSpecular = context_.scene.Effects().Needs(Effect::Specular);
  if (!followsSpecular && !context_.scene.HasMedia())  // nothing lies on the way, or beyond
    return segment.hit && segment.hit->material ? NonSpecular(segment, shortBounces) : Spectrum();
  Spectrum sum, throughput(1);
  for (int depth = 0;; ++depth) {
    const auto& hit = segment.hit;
    const MediaSegment media = AlongMedia(segment.ray, hit ? &hit->point.p : nullptr, context_);
    sum += throughput * media.radiance;
    throughput *= media.transmittance;
    if (!hit || !hit->material) return sum;
    sum += throughput * NonSpecular(segment, shortBounces);
    if (!followsSpecular || !Intersects(hit->material->PossibleLobes(), LobeSet::Specular))
      return sum;
    const Arena::Mark mark = context_.arena.GetMark();
    const ShadingPoint point = Shade(segment);
    if (depth == settings_.maxDepth) {
      context_.rays.cutGatherThroughput +=
          double((throughput * point.bsdf.Rho(LobeSet::Specular)).Y());
      context_.arena.Rewind(mark);
      return sum;
    }
    const auto bounce = FollowSpecular(point, random_);
    context_.arena.Rewind(mark);
    if (!bounce) return sum;
    throughput *= bounce->throughput;
    segment = TraceAndLook(SpawnRay(hit->point, bounce->wi));
  }
}

ShadingPoint GatherRadiance::Shade(const Segment& segment) const {
  return MakeShadingPoint(context_.scene.Complete(segment.ray, segment.hit->hit), segment.ray, 0,
                          TransportMode::Radiance, &context_.arena);
}

Spectrum GatherRadiance::NonSpecular(const Segment& segment, int shortBounces) const {
  const Scene::HitPoint& hit = *segment.hit;
  if (!Intersects(hit.material->PossibleLobes(), LobeSet::NonSpecular)) return {};
  bool isShort = false;
  if (radianceMap_) {
    const auto& entry = segment.entry;
    isShort = entry && DistanceSquared(segment.ray.o, hit.point.p) <
                           Square(settings_.shortRays) * entry->radius2;
    if (entry && !isShort) {
      if (context_.layers) {
        context_.layers->radianceDistance += double(std::sqrt(entry->distance2));
        ++context_.layers->radiancePhotonsRead;
      }
      if (settings_.radianceMode == RadianceMode::Exitant) return entry->value;
      return Reflected(segment, *entry);
    }
  }
  const Arena::Mark mark = context_.arena.GetMark();
  const ShadingPoint point = Shade(segment);
  const bool goesOn =
      isShort && settings_.shortGather == ShortGather::Gather && shortBounces < kMaxShortBounces;
  const Spectrum radiance =
      goesOn ? OneMoreBounce(point, shortBounces) : maps_.Radiance(point, &context_.arena);
  context_.arena.Rewind(mark);
  return radiance;
}

Spectrum GatherRadiance::Reflected(const Segment& segment, const RadianceMap::Entry& front) const {
  const Arena::Mark mark = context_.arena.GetMark();
  const ShadingPoint point = Shade(segment);
  Spectrum radiance = point.bsdf.Rho(LobeSet::NonSpecularReflection) * front.value * kInvPi;
  const Spectrum transmittance = context_.scene.Effects().Needs(Effect::Transmission)
                                     ? point.bsdf.Rho(LobeSet::NonSpecularTransmission)
                                     : Spectrum();
  if (!transmittance.IsBlack()) {
    const SurfacePoint& hit = segment.hit->point;
    const RestPose rest = PoseOf(*segment.hit);
    const Point3 p = rest.Point(hit.p);
    const Normal3 back = rest.Normal(-FaceForward(hit.ng, -segment.ray.d));
    const auto entry = radianceMap_->Find({p, back});
    const Spectrum e = entry ? entry->value : maps_.EstimateIrradiance(p, back, &context_.arena).e;
    radiance += transmittance * e * kInvPi;
  }
  context_.arena.Rewind(mark);
  return radiance;
}

Spectrum GatherRadiance::OneMoreBounce(const ShadingPoint& point, int shortBounces) const {
  Spectrum sum = maps_.Radiance(PhotonKind::Caustic, point, &context_.arena);
  if (!lights_.IsEmpty()) {
    const auto choice = lights_.Sample(random_->Uniform());
    DirectLightSample sample;
    sample.light = {random_->Uniform(), random_->Uniform()};
    sample.lightPart = random_->Uniform();
    sample.bsdf = {random_->Uniform(), random_->Uniform()};
    sample.bsdfLobe = random_->Uniform();
    sum += EstimateDirect(point, *choice.light, sample, context_) / choice.probability;
  }
  const Point2 u{random_->Uniform(), random_->Uniform()};
  if (const auto bounce =
          point.bsdf.Sample(point.Wo(), u, random_->Uniform(), LobeSet::NonSpecular))
    sum += bounce->throughput *
           Along(TraceAndLook(SpawnRay(point.surface, bounce->wi)), shortBounces + 1);
  return sum;
}

}  // namespace exphoton
