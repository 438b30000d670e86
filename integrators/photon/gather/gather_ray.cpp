// SPDX-License-Identifier: BSD-2-Clause
// GatherRay follows rays over specular and glossy surfaces to the radiance that they read.
#include "integrators/photon/gather/gather_ray.h"

#include <algorithm>

#include "core/math/sampling/mis.h"
#include "core/transport/light_sample.h"
#include "core/transport/specular/specular_bounce.h"
#include "core/transport/volume_integrator.h"
#include "integrators/photon/maps/rest_pose.h"

namespace exphoton {
namespace {

struct SpecularChoice {
  Vector3 wi;
  Spectrum throughput;
};

// Picks one specular lobe, reflection or transmission, in proportion to its throughput.
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

GatherRay::GatherRay(const PhotonMapSet& maps, const RadiancePhotonMap* radianceMap,
                     const PhotonSettings& settings, const LightSampler& lights, LiContext& context,
                     RandomStream* random)
    : maps_(maps),
      radianceMap_(radianceMap),
      settings_(settings),
      lights_(lights),
      context_(context),
      random_(random),
      mappedLobes_(radianceMap ? LobeSet::Diffuse : LobeSet::NonSpecular),
      followedLobes_(LobeSet::None) {
  const RequiredFeatures& features = context.scene.Features();
  if (features.Needs(Feature::Specular)) followedLobes_ = LobeSet::Specular;
  if (radianceMap && features.Needs(Feature::Glossy))
    followedLobes_ = followedLobes_ | LobeSet::Glossy;
}

void GatherRay::LookUp(std::span<Segment> segments) const {
  if (!radianceMap_) return;
  constexpr std::size_t kAtOnce = 16;
  RadiancePhotonMap::Place places[kAtOnce];
  Segment* of[kAtOnce];
  std::optional<RadiancePhotonMap::Entry> found[kAtOnce];
  std::size_t count = 0;
  const auto look = [&] {
    radianceMap_->Find({places, count}, found);
    for (std::size_t i = 0; i < count; ++i)
      if (!found[i] || !IsHidden(*found[i], places[i])) of[i]->entry = found[i];
    count = 0;
  };
  for (Segment& segment : segments) {
    if (!segment.hit || !segment.hit->material) continue;
    if (!Intersects(segment.hit->material->PossibleLobes(), mappedLobes_)) continue;
    const SurfacePoint& point = segment.hit->point;
    const RestPose rest = PoseOf(*segment.hit);
    places[count] = {rest.Point(point.p), rest.Normal(FaceForward(point.ng, -segment.ray.d))};
    of[count++] = &segment;
    if (count == kAtOnce) look();
  }
  look();
}

bool GatherRay::IsHidden(const RadiancePhotonMap::Entry& entry,
                         const RadiancePhotonMap::Place& place) const {
  if (!entry.isBesideWall) return false;
  const Vector3 up(place.n);
  return maps_.HidingWalls().AreBetween({place.p, up}, {entry.p, up});
}

Spectrum GatherRay::Along(Segment* segment) const {
  Walk walk(*segment);
  // Fast path for most segments: without media, a segment without lobes to follow ends the walk.
  if (!context_.scene.HasMedia() && !Any(LobesToFollow(*segment))) {
    if (segment->hit && segment->hit->material) walk.radiance = FromMaps(&walk);
  } else {
    Complete(&walk);
  }
  if (context_.signedLight) segment->signedRadiance = walk.signedRadiance;
  return walk.radiance;
}

void GatherRay::Observe(const ShadingPoint& point, const Reads& reads) const {
  if (observer_) observer_->Observe(point, reads);
  if (!context_.signedLight) return;
  Spectrum sum;
  for (std::size_t i = 0; i < reads.segments.size(); ++i)
    sum += reads.weights[i] * reads.segments[i].signedRadiance;
  *context_.signedLight += point.throughput * sum;
}

GatherRay::Arriving GatherRay::Follow(const Segment& segment, const SurfacePoint& from,
                                      Real pdf) const {
  Walk walk(segment);
  walk.from = from;
  walk.glossyPdf = pdf;
  Complete(&walk);
  return {walk.radiance, walk.correction};
}

void GatherRay::Complete(Walk* walk) const {
  do {
    const auto& hit = walk->segment.hit;
    const MediaSegment media =
        AlongMedia(walk->segment.ray, hit ? &hit->point.p : nullptr, context_);
    walk->Add(media.radiance);
    walk->throughput *= media.transmittance;
    if (walk->glossyPdf > 0) walk->Add(Emission(*walk));
    if (!hit || !hit->material) break;
    walk->Add(FromMaps(walk));
  } while (Continue(walk));
}

bool GatherRay::Continue(Walk* walk) const {
  const LobeSet lobes = LobesToFollow(walk->segment);
  if (!Any(lobes)) return false;
  if (!Intersects(lobes, LobeSet::Glossy)) return Bounce(LobeSet::Specular, walk);
  // Play Russian roulette before the BSDF is made, because making it takes as long as tracing a
  // ray. The survival probability is the glossy share of the surface (1 if unknown), from the
  // second glossy bounce on times the throughput.
  constexpr Real kMaxSurvival = Real(.95);  // ends walks where nothing is absorbed
  const auto& entry = walk->segment.entry;
  Real survival = entry && !Intersects(lobes, LobeSet::Specular) ? entry->packed.GlossyShare() : 1;
  if (walk->glossyBounces > 0)
    survival = std::min(survival * std::min(walk->throughput.Y(), Real(1)), kMaxSurvival);
  if (!(random_->Uniform() < survival)) return false;
  walk->throughput /= survival;
  return Bounce(lobes, walk);
}

bool GatherRay::Bounce(LobeSet lobes, Walk* walk) const {
  const Arena::Mark mark = context_.arena.GetMark();
  const ShadingPoint point = Shade(walk->segment);
  Real glossy = Intersects(lobes, LobeSet::Glossy) && point.bsdf.Has(LobeSet::Glossy) ? 1 : 0;
  if (glossy > 0 && Intersects(lobes, LobeSet::Specular) && point.bsdf.Has(LobeSet::Specular)) {
    // Choose one of glossy and specular, so that the walk does not branch.
    glossy = point.bsdf.Rho(LobeSet::Glossy).Y();
    glossy = SafeDivide(glossy, glossy + point.bsdf.Rho(LobeSet::Specular).Y(), Real(.5));
    glossy = std::clamp(glossy, Real(.1), Real(.9));
    const bool isGlossy = random_->Uniform() < glossy;
    walk->throughput /= isGlossy ? glossy : 1 - glossy;
    glossy = isGlossy ? 1 : 0;
  }
  const bool goesOn = glossy > 0 ? BounceGlossy(point, walk) : BounceSpecular(point, walk);
  context_.arena.Rewind(mark);
  return goesOn;
}

bool GatherRay::BounceGlossy(const ShadingPoint& point, Walk* walk) const {
  Spectrum signedCaustic;
  walk->Add(maps_.Radiance(PhotonKind::Caustic, point, &context_.arena, LobeSet::Glossy,
                           context_.signedLight ? &signedCaustic : nullptr));
  walk->signedRadiance += walk->throughput * signedCaustic;
  walk->Add(GlossyDirect(point));
  const Point2 u{random_->Uniform(), random_->Uniform()};
  const auto bounce = point.bsdf.Sample(point.Wo(), u, random_->Uniform(), LobeSet::Glossy);
  if (!bounce || bounce->throughput.IsBlack()) return false;
  walk->throughput *= bounce->throughput;
  walk->glossyPdf = bounce->pdf;
  ++walk->glossyBounces;
  walk->from = walk->segment.hit->point;
  walk->segment = TraceAndLookUp(SpawnRay(walk->from, bounce->wi));
  return true;
}

bool GatherRay::BounceSpecular(const ShadingPoint& point, Walk* walk) const {
  if (walk->specularBounces == settings_.maxDepth) {
    context_.rays.cutGatherThroughput +=
        double((walk->throughput * point.bsdf.Rho(LobeSet::Specular)).Y());
    return false;
  }
  const auto bounce = FollowSpecular(point, random_);
  if (!bounce) return false;
  walk->throughput *= bounce->throughput;
  const Real chance = SpecularSurvival(walk->throughput, 1);
  if (chance < 1 && !(random_->Uniform() < chance)) return false;
  walk->throughput /= chance;
  walk->glossyPdf = 0;
  ++walk->specularBounces;
  walk->segment = TraceAndLookUp(SpawnRay(walk->segment.hit->point, bounce->wi));
  return true;
}

Spectrum GatherRay::GlossyDirect(const ShadingPoint& point) const {
  if (lights_.IsEmpty()) return {};
  const auto choice = lights_.Sample(point.surface.p, random_->Uniform());
  const Point2 place{random_->Uniform(), random_->Uniform()};
  const SampledLight sample{choice.light, choice.probability, place, random_->Uniform()};
  return FromLightSample(point, sample, {}, LobeSet::Glossy, context_);
}

Spectrum GatherRay::Emission(const Walk& walk) const {
  const auto& hit = walk.segment.hit;
  const Vector3& w = walk.segment.ray.d;
  const auto weight = [&](const Light& light, const SurfacePoint* on) {
    const Real lightPdf = lights_.Pmf(walk.from.p, light) * light.PdfDirect(walk.from, w, on);
    return PowerHeuristic(1, walk.glossyPdf, 1, lightPdf);
  };
  Spectrum sum;
  if (!hit) {
    for (const Light* light : context_.scene.InfiniteLights())
      sum += light->Le(w) * weight(*light, nullptr);
    return sum;
  }
  const AreaLight* light = context_.scene.Primitives().Attributes(hit->hit).areaLight;
  if (!light) return sum;
  const SurfaceInteraction surface = context_.scene.Complete(walk.segment.ray, hit->hit);
  const Spectrum emitted = light->L(surface, surface.uv, surface.wo);
  return emitted.IsBlack() ? emitted : emitted * weight(*light, &surface);
}

ShadingPoint GatherRay::Shade(const Segment& segment) const {
  return MakeShadingPoint(context_.scene.Complete(segment.ray, segment.hit->hit), segment.ray, 0,
                          TransportMode::Radiance, &context_.arena);
}

Spectrum GatherRay::FromMaps(Walk* walk) const {
  const Segment& segment = walk->segment;
  if (!Intersects(segment.hit->material->PossibleLobes(), mappedLobes_)) return {};
  Spectrum signedRead;
  const Spectrum read = ReadMaps(segment, context_.signedLight ? &signedRead : nullptr);
  if (context_.signedLight) walk->signedRadiance += walk->throughput * signedRead;
  if (corrector_)
    walk->correction += walk->throughput * corrector_->Correct(segment, read, walk->throughput.Y());
  return read;
}

Spectrum GatherRay::ReadMaps(const Segment& segment, Spectrum* signedRadiance) const {
  const Scene::HitPoint& hit = *segment.hit;
  bool isShort = false;
  if (radianceMap_) {
    const auto& entry = segment.entry;
    isShort = entry && DistanceSquared(segment.ray.o, hit.point.p) <
                           Square(settings_.shortRays) * entry->radius2;
    if (entry && !isShort) {
      if (context_.aovs) {
        context_.aovs->radianceDistance += double(std::sqrt(entry->distance2));
        ++context_.aovs->radiancePhotonsRead;
      }
      const Real absCos = AbsDot(hit.point.ng, segment.ray.d);
      if (signedRadiance) *signedRadiance = entry->SignedValue(absCos);
      return entry->Value(absCos);
    }
  }
  const Arena::Mark mark = context_.arena.GetMark();
  const ShadingPoint point = Shade(segment);
  const Spectrum radiance = maps_.Radiance(point, &context_.arena, mappedLobes_, signedRadiance,
                                           HiddenPhotons::LeftOutInTheMean);
  context_.arena.Rewind(mark);
  return radiance;
}

}  // namespace exphoton
