// SPDX-License-Identifier: BSD-2-Clause
// TileRenderer: the light of emitters that the camera sees, averaged over times and places.
#include <algorithm>

#include "core/math/sampling/sampling.h"
#include "core/render/tile_renderer.h"

namespace exphoton {
namespace {

// Replaces a part of *L. Rounding may have made the part larger than the whole.
void Replace(const Spectrum& part, const Spectrum& by, Spectrum* L) {
  for (int c = 0; c < Spectrum::kChannels; ++c)
    if ((*L)[c] >= 0) (*L)[c] = std::max((*L)[c] - part[c], Real(0)) + by[c];
}

}  // namespace

void TileRenderer::AverageTimes(const TracedSample& sample, RenderWorker* worker, Spectrum* L,
                                AovSample* aovs) const {
  const bool hasBounced =
      movingEmitters_.FollowsSpecularRays() && SpecularRays(*worker) > sample.specularRays;
  if (!hasBounced && !movingEmitters_.MayMeet(sample.ray)) return;
  RayCounters* const rays = &worker->totals.rays;
  const EmittedLight own = movingEmitters_.Along(sample.ray, sample.context, rays);
  if (!own.isNear) return;
  EmissionMean mean(own);
  CameraSamples& samples = worker->samples;
  const Point2 film = PlaceOf(sample.pixel, sample.filter);
  const Real time = samples.time;
  for (int i = 1; i < MovingEmitters::kTimes; ++i) {
    const Real later = time + Real(i) / Real(MovingEmitters::kTimes);
    samples.time = later < 1 ? later : later - 1;
    mean.Add(movingEmitters_.Along(CameraRay(film, samples), sample.context, rays));
  }
  samples.time = time;
  Replace(own.first + own.specular, mean.First() + mean.Specular(), L);
  Replace(own.first, mean.First(), &aovs->emission);
  Replace(own.specular, mean.Specular(), &aovs->specular);
}

void TileRenderer::AveragePlaces(const TracedSample& sample, RenderWorker* worker, Spectrum* L,
                                 AovSample* aovs) const {
  if (!target_.stillEmitters || !target_.film.Crop().Contains(sample.pixel.x, sample.pixel.y))
    return;
  const StillEmitters& emitters = *target_.stillEmitters;
  const auto raysIn = [&](Point2i pixel) { return RaysOfReflection(pixel, worker); };
  const int ofReflections = emitters.PlacesForReflections(sample.pixel, raysIn);
  const bool isReflected = ofReflections > 1;
  const int places = std::max(emitters.PlacesIn(sample.pixel), ofReflections);
  const auto tiny = emitters.Tiny().In(sample.pixel);
  if (places == 1 && tiny.empty()) return;
  RayCounters* const rays = &worker->totals.rays;
  const auto lightAlong = [&](const RayDifferential& ray) {
    return isReflected ? emitters.AllAlong(ray, sample.context, rays) : emitters.FirstAlong(ray);
  };
  const EmittedLight own = lightAlong(sample.ray);
  EmittedLight mean;
  mean.first = TinyLight(sample, worker);
  mean.Add(emitters.Tiny().Without(tiny, own), Real(1) / Real(places));
  bool isEdge = !tiny.empty();
  for (int i = 1; i < places; ++i) {
    const FilterSample filter =
        job_.filter.Sample(StillEmitters::Place(worker->samples.film, i, places));
    const EmittedLight other =
        lightAlong(CameraRay(PlaceOf(sample.pixel, filter), worker->samples));
    if (!isReflected) rays->Count(RayKind::Camera);
    isEdge = isEdge || !other.HasSameColors(own);
    mean.Add(emitters.Tiny().Without(tiny, other),
             filter.weight / (Real(places) * sample.filter.weight));
  }
  if (!isEdge) return;
  Replace(own.first + own.specular, mean.first + mean.specular, L);
  Replace(own.first, mean.first, &aovs->emission);
  Replace(own.specular, mean.specular, &aovs->specular);
}

Spectrum TileRenderer::TinyLight(const TracedSample& sample, RenderWorker* worker) const {
  const StillEmitters& emitters = *target_.stillEmitters;
  Point2& lens = worker->samples.lens;
  const Point2 own = lens;
  Spectrum light;
  for (const TinyEmitters::InPixel& one : emitters.Tiny().In(sample.pixel)) {
    const TinyEmitters::Emitter& emitter = emitters.Tiny()[one];
    for (int i = 0; i < emitter.lensPlaces; ++i) {
      lens = StillEmitters::Place(own, i, emitter.lensPlaces);
      AddLight(emitter, sample, worker, &light);
    }
  }
  lens = own;
  return light / sample.filter.weight;
}

void TileRenderer::AddLight(const TinyEmitters::Emitter& emitter, const TracedSample& sample,
                            RenderWorker* worker, Spectrum* light) const {
  const TinyEmitters& emitters = target_.stillEmitters->Tiny();
  const Point2 centre = PlaceOf(sample.pixel, {{}, 1});
  const Point2 lens = emitter.border.empty() ? Point2() : SampleDisk(worker->samples.lens);
  const FilmBox box = emitters.BoxIn(emitter, centre, lens);
  if (box.IsEmpty()) return;
  const Real area = Real(box.Area()) / Real(emitter.places * emitter.lensPlaces);
  for (int i = 0; i < emitter.places; ++i) {
    const Point2 place = box.At(StillEmitters::Place(worker->samples.film, i, emitter.places));
    worker->totals.rays.Count(RayKind::Camera);
    const EmittedLight seen = target_.stillEmitters->FirstAlong(CameraRay(place, worker->samples));
    if (seen.lamp == emitter.light)
      *light += seen.first * (area * emitters.FilterDensity(place - centre));
  }
}

int TileRenderer::RaysOfReflection(Point2i pixel, RenderWorker* worker) const {
  constexpr std::uint64_t kReflectionStream = 0x7265666c6563ull;
  const std::uint64_t key =
      HashKey({options_.seed, std::uint64_t(pixel.x), std::uint64_t(pixel.y), kReflectionStream});
  RandomStream random(key);
  const Real time = random.Uniform();  // also in passes with a time of their own
  RayCounters rays;                    // not of the render: two threads may count the same rays
  const LiContext context{job_.scene, worker->samples, worker->arena, rays, key};
  constexpr int kMaxTrees = 4;  // 1 if the first tree has no specular rays
  constexpr std::uint64_t kManyRays = 12;
  int trees = 0;
  bool isShown = false;
  do {
    CameraSample sample;
    sample.film.y = Real(pixel.y) + random.Uniform();
    sample.film.x = Real(pixel.x) + random.Uniform();
    sample.lens = Point2(Real(.5), Real(.5));
    sample.time = Needs(Feature::Motion) ? time : 0;
    const EmittedLight light = target_.stillEmitters->AllAlong(CameraRay(sample), context, &rays);
    isShown = isShown || !light.specular.IsBlack();
    ++trees;
  } while (trees < kMaxTrees && rays.Total() > std::uint64_t(trees) && rays.Total() < kManyRays);
  return isShown ? int(std::min<std::uint64_t>(rays.Total() / std::uint64_t(trees), 1000)) : 0;
}

}  // namespace exphoton
