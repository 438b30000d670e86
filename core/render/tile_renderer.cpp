// SPDX-License-Identifier: BSD-2-Clause
// TileRenderer: from the camera sample to the film. A tile is only a unit of work.
#include "core/render/tile_renderer.h"

#include <algorithm>
#include <chrono>
#include <sstream>

#include "core/render/certificate/corrections.h"
#include "core/render/photon_noise.h"
#include "core/transport/cut_light.h"
#include "core/transport/shading_point.h"

namespace exphoton {
namespace {

using Clock = std::chrono::steady_clock;

// Scales the ray differentials from the pixel spacing to the mean spacing of a pixel's samples.
void ScaleDifferentials(RayDifferential* ray, Real scale) {
  ray->xOrigin = ray->o + (ray->xOrigin - ray->o) * scale;
  ray->yOrigin = ray->o + (ray->yOrigin - ray->o) * scale;
  ray->xDirection = ray->d + (ray->xDirection - ray->d) * scale;
  ray->yDirection = ray->d + (ray->yDirection - ray->d) * scale;
}

// `seed` is the user's seed. The seed of a pass is derived from it.
std::string Describe(const Spectrum& L, const SampleKey& key, std::uint64_t seed) {
  std::ostringstream text;
  text << "radiance (" << L.r << ", " << L.g << ", " << L.b << ") at pixel " << key.pixel.x << ","
       << key.pixel.y << ", sample " << key.index << ", seed " << seed;
  if (key.seed != seed) text << " (of a pass: " << key.seed << ")";
  return text.str();
}

// Fills the AOVs of the first surface without the integrator.
void DescribeSurface(const RenderJob& job, const RayDifferential& ray, Arena* arena,
                     AovSample* sample) {
  const auto surface = job.scene.Intersect(ray);
  if (!surface) return;
  const Arena::Mark mark = arena->GetMark();
  const ShadingPoint point = MakeShadingPoint(*surface, ray, 0, TransportMode::Radiance, arena);
  sample->isHit = true;
  sample->albedo = Clamp(point.bsdf.Rho(LobeSet::All), 0, 1);  // some measured lobes exceed 1
  sample->n = FaceForward(point.bsdf.Ns(), point.Wo());
  sample->ng = FaceForward(point.surface.ng, point.Wo());
  sample->p = point.surface.p;
  sample->depth = job.camera.Depth(point.surface.p, ray.time);
  sample->uv = point.surface.uv;
  sample->objectId = point.surface.objectId;
  sample->materialId = point.surface.materialId;
  arena->Rewind(mark);
}

void Blacken(AovSample* sample) {
  sample->emission = sample->direct = sample->caustic = sample->indirect = sample->specular = {};
}

// Sets negative components of L to 0, and the same components of the light AOVs.
void ClampNegative(Spectrum* L, AovSample* sample) {
  for (Real Spectrum::*channel : {&Spectrum::r, &Spectrum::g, &Spectrum::b}) {
    if (!(L->*channel < 0)) continue;
    for (Spectrum* part : {L, &sample->emission, &sample->direct, &sample->caustic,
                           &sample->indirect, &sample->specular})
      part->*channel = 0;
  }
}

std::uint64_t GatherRays(const RenderWorker& worker) {
  return worker.totals.rays.counts[std::size_t(RayKind::Gather)];
}

}  // namespace

TileRenderer::TileRenderer(const RenderJob& job, const RenderOptions& options, const Target& target,
                           NonFiniteLog* log)
    : job_(job),
      options_(options),
      target_(target),
      log_(log),
      aovs_(options.aovs),
      pixels_(double(target.film.Crop().Width()) * double(target.film.Crop().Height())),
      differentialScale_(Real(1 / std::sqrt(double(FootprintSamples(job, options))))),
      // A pass with a time of its own shows this time alone.
      movingEmitters_(job.scene, job.camera,
                      target.pass.time ? std::nullopt : job.integrator.EmissionDepth()) {
  // A progressive sampler goes on beyond its number of samples.
  const Sampler& sampler = target.sampler;
  if (target.edges && !sampler.IsProgressive())
    edgeSampler_ =
        sampler.WithSamplesPerPixel(sampler.SamplesPerPixel() * job.integrator.EdgeSamples());
}

void TileRenderer::RenderTile(const PixelBounds& tile, RenderWorker* worker) const {
  for (int y = tile.y0; y < tile.y1; ++y)
    if (worker->wasStopped || !RenderRow(tile, y, worker)) return;
  if (!options_.view) return;
  const PixelBounds& crop = target_.film.Crop();
  const PixelBounds part{std::max(tile.x0, crop.x0), std::max(tile.y0, crop.y0),
                         std::min(tile.x1, crop.x1), std::min(tile.y1, crop.y1)};
  if (!part.IsEmpty()) options_.view->Show(target_.film, part);
}

bool TileRenderer::RenderRow(const PixelBounds& tile, int y, RenderWorker* worker) const {
  const std::uint64_t raysBefore = worker->totals.rays.Total();
  int rendered = 0;
  bool goesOn = true;
  for (int x = tile.x0; x < tile.x1 && goesOn; ++x) {
    if (target_.done->Has({x, y})) continue;
    goesOn = !IsPaused() && RenderPixel({x, y}, worker);
    if (!goesOn) break;
    worker->wholeTotals = worker->totals;
    target_.done->Set({x, y});
    ++rendered;
  }
  if (rendered == 0) return goesOn;
  target_.progress.CountRays(worker->totals.rays.Total() - raysBefore);
  target_.progress.Advance(rendered);
  return goesOn;
}

bool TileRenderer::RenderPixel(Point2i pixel, RenderWorker* worker) const {
  const bool isInPicture = target_.film.Crop().Contains(pixel.x, pixel.y);
  if (!aovs_ || !aovs_->NeedsTime() || !isInPicture) return RenderSamples(pixel, worker);
  const Clock::time_point start = Clock::now();
  const bool isDone = RenderSamples(pixel, worker);
  aovs_->AddTime(pixel, std::chrono::duration<double>(Clock::now() - start).count());
  return isDone;
}

bool TileRenderer::RenderSamples(Point2i pixel, RenderWorker* worker) const {
  worker->pixelState.Reset();
  if (target_.splats) worker->splat.Begin(target_.splats, pixel);
  const bool isWhole = RenderAllSamples(pixel, worker);
  // The samples of an unfinished pixel join the picture after the last checkpoint.
  if (target_.splats && isWhole) worker->splat.End();
  if (target_.gathers) target_.gathers->At(pixel).Finish();
  return isWhole;
}

bool TileRenderer::RenderAllSamples(Point2i pixel, RenderWorker* worker) const {
  const int parts = target_.edges && target_.edges->Has(pixel) ? job_.integrator.EdgeSamples() : 1;
  const std::int64_t end = target_.pass.firstSample + target_.pass.sampleCount;
  for (std::int64_t i = target_.pass.firstSample * parts; i < end * parts; ++i) {
    if (IsStopped()) {
      worker->wasStopped = true;
      return false;
    }
    RenderSample({target_.pass.sampleSeed, pixel, i}, parts, worker);
  }
  return true;
}

// Light that is not finite counts as black, and negative light as 0.
void TileRenderer::MakeUsable(const SampleKey& key, RenderWorker* worker, Spectrum* L,
                              AovSample* aovs) const {
  if (!L->IsFinite()) {
    Drop(*L, key, worker);
    *L = Spectrum();
    Blacken(aovs);
    worker->gathers.clear();
  } else if (L->MinComponent() < 0) {
    ++worker->totals.negative;
    ClampNegative(L, aovs);
  }
}

void TileRenderer::RenderSample(const SampleKey& key, int parts, RenderWorker* worker) const {
  CameraSamples& samples = worker->samples;
  const bool isDivided = parts > 1;
  (isDivided && edgeSampler_ ? *edgeSampler_ : target_.sampler).Generate(key, &samples);
  const FilterSample filter = target_.splats
                                  ? FilterSample{samples.film - Point2(Real(.5), Real(.5)), 1}
                                  : job_.filter.Sample(samples.film);
  const Real share = 1 / Real(parts), weight = filter.weight * share;
  const Point2 film = PlaceOf(key.pixel, filter);
  const RayDifferential ray = CameraRay(film, samples);

  LiContext context = MakeContext(key, parts, worker);
  ErrorSample errors;
  RequestErrors(&context, &errors);
  AovSample aovs;
  if (aovs_) {
    aovs.wanted = aovs_->Wanted();
    context.aovs = &aovs;
    if (aovs_->NeedsSurface()) DescribeSurface(job_, ray, &worker->arena, &aovs);
  }
  const std::uint64_t specularRays = SpecularRays(*worker), gatherRays = GatherRays(*worker);
  Spectrum L = job_.integrator.Li(ray, context);
  errors.correction.gatherRays = std::int64_t(GatherRays(*worker) - gatherRays);
  if (key.index % parts == 0) Count(context, &worker->totals);  // its parts count as one
  const Real alpha = std::isfinite(context.alpha) ? context.alpha : Real(1);
  for (const GatherRecord& gather : worker->gathers)
    if (!gather.IsFinite()) L += gather.light * gather.weight;  // not finite either
  const TracedSample sample{key.pixel, filter, ray, context, specularRays};
  AverageTimes(sample, worker, &L, &aovs);
  AveragePlaces(sample, worker, &L, &aovs);
  MakeUsable(key, worker, &L, &aovs);
  if (target_.gathers) {
    const int group = GatherGroup(key.pixel, key.index);
    target_.gathers->At(key.pixel).Add(worker->gathers, film, weight, {group, share});
    for (const GatherRecord& gather : worker->gathers)
      aovs.ownGathers += gather.light * gather.weight;
  }
  AddErrors(key.pixel, errors, weight);
  if (target_.splats)
    return worker->splat.Add({samples.film, L, alpha, aovs_ ? &aovs : nullptr, share});
  if (!target_.film.Crop().Contains(key.pixel.x, key.pixel.y)) return;
  target_.film.AddSample(key.pixel, L, alpha, weight);
  if (aovs_) aovs_->AddSample(key.pixel, aovs, L, weight);
}

void TileRenderer::Count(const LiContext& context, RenderTotals* totals) {
  ++totals->cameraSamples;
  if (!context.measuresCutLight) return;
  ++totals->rays.cutLightSamples;
  totals->rays.cutLight += context.cutLight;
  totals->rays.cutLightSquares += context.cutLight * context.cutLight;
}

LiContext TileRenderer::MakeContext(const SampleKey& key, int parts, RenderWorker* worker) const {
  worker->arena.Reset();
  LiContext context{job_.scene, worker->samples, worker->arena, worker->totals.rays,
                    HashKey({key.seed, std::uint64_t(key.pixel.x), std::uint64_t(key.pixel.y),
                             std::uint64_t(key.index)})};
  const auto earlier = target_.samplesBefore + key.index / parts - target_.pass.firstSample;
  const std::uint64_t period = CutLightPeriod(pixels_ * double(earlier), pixels_);
  context.measuresCutLight = key.index % parts == 0 && IsCutLightMeasured(context.key, period);
  context.isDivided = parts > 1;
  context.pixelState = &worker->pixelState;
  context.threadState = &worker->threadState;
  context.volume = job_.volume;
  worker->gathers.clear();
  if (target_.gathers) context.gathers = &worker->gathers;
  return context;
}

void TileRenderer::RequestErrors(LiContext* context, ErrorSample* errors) const {
  if (options_.corrections) {
    errors->correction.share = options_.corrections->Share();
    context->correction = &errors->correction;
  }
  if (target_.pass.photonNoise) context->signedLight = &errors->signedLight;
}

// A block of pixels is much wider than the filter, and so is the noise of photons, so splatted
// samples count in their own pixel.
void TileRenderer::AddErrors(Point2i pixel, const ErrorSample& errors, Real weight) const {
  if (options_.corrections) options_.corrections->Add(pixel, errors.correction, weight);
  if (target_.pass.photonNoise) target_.pass.photonNoise->Add(pixel, errors.signedLight, weight);
}

CameraSample TileRenderer::AtPlace(Point2 film, const CameraSamples& samples) const {
  CameraSample sample;
  sample.film = film;
  sample.lens = Needs(Feature::Lens) ? samples.lens : Point2(Real(.5), Real(.5));
  sample.time = Needs(Feature::Motion) ? target_.pass.time.value_or(samples.time) : 0;
  return sample;
}

RayDifferential TileRenderer::CameraRay(const CameraSample& sample) const {
  RayDifferential ray = job_.camera.GenerateRay(sample, Needs(Feature::Filtering));
  if (ray.hasDifferentials) ScaleDifferentials(&ray, differentialScale_);
  return ray;
}

void TileRenderer::Drop(const Spectrum& L, const SampleKey& key, RenderWorker* worker) const {
  const std::string text = Describe(L, key, options_.seed);
  if (options_.isStrict) throw Error(ExitStatus::Internal, "non-finite " + text);
  ++worker->totals.nonFinite;
  log_->Add(key.pixel, key.index, text);
}

std::int64_t FootprintSamples(const RenderJob& job, const RenderOptions& options) {
  if (options.footprintSamples > 0) return options.footprintSamples;
  return std::max<std::int64_t>(job.sampler.SamplesPerPixel(), 1);
}

}  // namespace exphoton
