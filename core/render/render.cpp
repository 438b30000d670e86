// SPDX-License-Identifier: BSD-2-Clause
// The tile loop. A tile is only a unit of work. Every camera sample is a function of (seed, pixel,
// sample index). One thread adds up a pixel's samples in the order of their index.
#include "core/render/render.h"

#include <algorithm>
#include <chrono>
#include <deque>
#include <sstream>

#include "core/render/render_totals.h"
#include "core/render/sharing/shared_gathers.h"
#include "core/render/sharing/sharing_plan.h"
#include "core/render/splat_buffer.h"
#include "core/render/tiles.h"
#include "core/transport/shading_point.h"

namespace exphoton {
namespace {

// The state of one thread. The alignment of its Arena keeps workers on separate cache lines.
struct Worker {
  explicit Worker(const SampleLayout& layout) : samples(layout) {}

  CameraSamples samples;
  Arena arena;
  GatherRecords gathers;
  PixelState pixelState;
  ThreadState threadState;
  SplatBuffer::Pixel splat;
  RenderTotals totals;
  bool wasStopped = false;
};

std::int64_t FootprintSamples(const RenderJob& job, const RenderOptions& options) {
  if (options.footprintSamples > 0) return options.footprintSamples;
  return std::max<std::int64_t>(job.sampler.SamplesPerPixel(), 1);
}

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
void DescribeSurface(const Scene& scene, const RayDifferential& ray, Arena* arena,
                     AovSample* sample) {
  const auto surface = scene.Intersect(ray);
  if (!surface) return;
  const Arena::Mark mark = arena->GetMark();
  const ShadingPoint point = MakeShadingPoint(*surface, ray, 0, TransportMode::Radiance, arena);
  sample->albedo = point.bsdf.Rho(LobeSet::All);
  sample->n = FaceForward(point.bsdf.Ns(), point.Wo());
  sample->p = point.surface.p;
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

class TileRenderer {
 public:
  struct Target {
    const RenderPass& pass;
    const Sampler& sampler;
    Film& film;
    ProgressReporter& progress;
    GatherFragments* gathers;  // null if gathers are not shared
    SplatBuffer* splats;       // null if samples contribute to their own pixels only
  };

  TileRenderer(const RenderJob& job, const RenderOptions& options, const Target& target,
               NonFiniteLog* log)
      : job_(job),
        options_(options),
        target_(target),
        log_(log),
        aovs_(options.aovs),
        differentialScale_(Real(1 / std::sqrt(double(FootprintSamples(job, options))))) {}

  void RenderTile(const PixelBounds& tile, Worker* worker) const {
    for (int y = tile.y0; y < tile.y1; ++y) {
      const std::uint64_t raysBefore = worker->totals.rays.Total();
      for (int x = tile.x0; x < tile.x1; ++x)
        if (!RenderPixel({x, y}, worker)) return;
      target_.progress.CountRays(worker->totals.rays.Total() - raysBefore);
      target_.progress.Advance(tile.Width());
    }
  }

 private:
  using Clock = std::chrono::steady_clock;

  bool Needs(Feature feature) const { return job_.scene.Features().Needs(feature); }
  bool IsStopped() const { return options_.stop && options_.stop->load(std::memory_order_relaxed); }

  // Returns false if rendering was stopped.
  bool RenderPixel(Point2i pixel, Worker* worker) const {
    const bool isInPicture = target_.film.Crop().Contains(pixel.x, pixel.y);
    if (!aovs_ || !aovs_->NeedsTime() || !isInPicture) return RenderSamples(pixel, worker);
    const Clock::time_point start = Clock::now();
    const bool isDone = RenderSamples(pixel, worker);
    aovs_->AddTime(pixel, std::chrono::duration<double>(Clock::now() - start).count());
    return isDone;
  }

  bool RenderSamples(Point2i pixel, Worker* worker) const {
    worker->pixelState.Reset();
    if (target_.splats) worker->splat.Begin(target_.splats, pixel);
    const bool isWhole = RenderAllSamples(pixel, worker);
    if (target_.splats) worker->splat.End();
    if (target_.gathers) target_.gathers->At(pixel).Finish();
    return isWhole;
  }

  // Returns false if rendering was stopped.
  bool RenderAllSamples(Point2i pixel, Worker* worker) const {
    const std::int64_t end = target_.pass.firstSample + target_.pass.sampleCount;
    for (std::int64_t i = target_.pass.firstSample; i < end; ++i) {
      if (IsStopped()) {
        worker->wasStopped = true;
        return false;
      }
      RenderSample({target_.pass.sampleSeed, pixel, i}, worker);
    }
    return true;
  }

  void RenderSample(const SampleKey& key, Worker* worker) const {
    CameraSamples& samples = worker->samples;
    target_.sampler.Generate(key, &samples);
    const Point2 half(Real(.5), Real(.5));
    const FilterSample filter =
        target_.splats ? FilterSample{samples.film - half, 1} : job_.filter.Sample(samples.film);
    const Point2 film = Point2(Real(key.pixel.x), Real(key.pixel.y)) + half + filter.offset;
    const RayDifferential ray = CameraRay(film, samples);

    worker->arena.Reset();
    LiContext context{job_.scene, samples, worker->arena, worker->totals.rays,
                      HashKey({key.seed, std::uint64_t(key.pixel.x), std::uint64_t(key.pixel.y),
                               std::uint64_t(key.index)})};
    context.pixelState = &worker->pixelState;
    context.threadState = &worker->threadState;
    context.volume = job_.volume;
    worker->gathers.clear();
    if (target_.gathers) context.gathers = &worker->gathers;
    AovSample aovs;
    if (aovs_) {
      aovs.wanted = aovs_->Wanted();
      context.aovs = &aovs;
      if (aovs_->NeedsSurface()) DescribeSurface(job_.scene, ray, &worker->arena, &aovs);
    }
    Spectrum L = job_.integrator.Li(ray, context);
    ++worker->totals.cameraSamples;
    const Real alpha = std::isfinite(context.alpha) ? context.alpha : Real(1);
    for (const GatherRecord& gather : worker->gathers)
      if (!gather.IsFinite()) L += gather.light * gather.weight;  // not finite either
    if (!L.IsFinite()) {
      Drop(L, key, worker);
      L = Spectrum();
      Blacken(&aovs);
      worker->gathers.clear();
    } else if (L.MinComponent() < 0) {
      ++worker->totals.negative;
      ClampNegative(&L, &aovs);
    }
    if (target_.gathers) {
      // Neighbouring samples and neighbouring pixels belong to different halves.
      const int half = int((key.index + key.pixel.x + key.pixel.y) & 1);
      target_.gathers->At(key.pixel).Add(worker->gathers, film, filter.weight, half);
    }
    if (target_.splats) return worker->splat.Add({samples.film, L, alpha, aovs_ ? &aovs : nullptr});
    if (!target_.film.Crop().Contains(key.pixel.x, key.pixel.y)) return;
    target_.film.AddSample(key.pixel, L, alpha, filter.weight);
    if (aovs_) aovs_->AddSample(key.pixel, aovs, L, filter.weight);
  }

  RayDifferential CameraRay(Point2 film, const CameraSamples& samples) const {
    CameraSample sample;
    sample.film = film;
    sample.lens = Needs(Feature::Lens) ? samples.lens : Point2(Real(.5), Real(.5));
    sample.time = Needs(Feature::Motion) ? samples.time : 0;
    RayDifferential ray = job_.camera.GenerateRay(sample, Needs(Feature::Filtering));
    if (ray.hasDifferentials) ScaleDifferentials(&ray, differentialScale_);
    return ray;
  }

  void Drop(const Spectrum& L, const SampleKey& key, Worker* worker) const {
    const std::string text = Describe(L, key, options_.seed);
    if (options_.isStrict) throw Error(ExitStatus::Internal, "non-finite " + text);
    ++worker->totals.nonFinite;
    log_->Add(key.pixel, key.index, text);
  }

  const RenderJob& job_;
  const RenderOptions& options_;
  Target target_;
  NonFiniteLog* log_;
  AovFilm* aovs_;
  Real differentialScale_;
};

// Returns the pixels whose gathers the window needs. `reach` is the number of pixels that samples
// are splatted over; those beyond the full image count, too.
PixelBounds Enlarged(const PixelBounds& window, const PixelBounds& full, int reach) {
  const int margin = SharingMargin();
  return {
      std::max(window.x0 - margin, full.x0 - reach), std::max(window.y0 - margin, full.y0 - reach),
      std::min(window.x1 + margin, full.x1 + reach), std::min(window.y1 + margin, full.y1 + reach)};
}

}  // namespace

struct PassRenderer::State {
  State(const RenderJob& aJob, const RenderOptions& someOptions)
      : job(aJob),
        options(someOptions),
        splatWeights(SplatWeights::Of(job.filter)),
        sharing(PlanSharing(job.integrator, job.scene, job.camera,
                            options.aovs ? options.aovs->Wanted() : AovSet())) {
    if (!sharing.isOn && !sharing.reason.empty())
      job.log.Notice("gathers are not shared: " + sharing.reason);
  }

  void Preprocess(std::uint64_t seed, ProgressReporter& progress) {
    Log& log = passes == 0 ? job.log : mutedLog;
    const PixelBounds& full = job.film.Full();
    PreprocessContext context{job.threads,
                              seed,
                              log,
                              progress,
                              job.statistics,
                              options.isStrict,
                              &job.camera,
                              {full.Width(), full.Height()},
                              job.volume,
                              Stop()};
    // The integrator may march through media while it prepares.
    if (job.volume) job.volume->Preprocess(job.scene);
    job.integrator.Preprocess(job.scene, context);
  }

  void RenderPixels(const TileRenderer::Target& target, const PixelBounds& window) {
    const PhaseTimer timer(job.statistics, "render");
    const Tiles tiles(window, options);
    const TileRenderer renderer(job, options, target, &nonFinite);
    if (options.pixelsBegun) *options.pixelsBegun = true;
    job.progress.Begin("Rendering", std::int64_t(window.Width()) * window.Height());
    job.threads.For(tiles.Count(), [&](std::int64_t number, int worker) {
      renderer.RenderTile(tiles.Get(number), &workers[std::size_t(worker)]);
    });
    job.progress.End();
  }

  void ShareGathers(const GatherFragments& gathers, const SharedLightTarget& target) {
    const PhaseTimer timer(job.statistics, "share");
    const double radius = AddSharedLight(gathers, &job.threads, target);
    job.statistics.SetCounter("render/sharing radius", radius,
                              "pixels, mean radius of the windows of shared gathers");
  }

  // If options.pixelsBegun is given, preprocessing sees the stop flag only after the first pixels
  // have begun. Before that, the caller itself ends the process.
  const std::atomic<bool>* Stop() const {
    return !options.pixelsBegun || *options.pixelsBegun ? options.stop : nullptr;
  }

  const RenderJob& job;
  const RenderOptions& options;
  const std::unique_ptr<const SplatWeights> splatWeights;  // null: samples are not splatted
  const SharingPlan sharing;
  std::deque<Worker> workers;
  bool wasStopped = false;  // while preprocessing
  NonFiniteLog nonFinite;
  Log mutedLog{Log::Level::Quiet, Log::Sink::Memory};
  int passes = 0;
  RenderTotals totals;
  std::optional<std::uint64_t> preparedSeed;  // of the last preprocessing
  double preprocessSeconds = 0, renderSeconds = 0;
};

PassRenderer::PassRenderer(const RenderJob& job, const RenderOptions& options)
    : state_(std::make_unique<State>(job, options)) {
  SampleLayout layout;
  layout.needsLens = job.scene.Features().Needs(Feature::Lens);
  layout.needsTime = job.scene.Features().Needs(Feature::Motion);
  job.integrator.RequestSamples(job.scene, job.sampler, &layout);
  for (int i = 0; i < job.threads.Count(); ++i) state_->workers.emplace_back(layout);
}

PassRenderer::~PassRenderer() = default;

double PassRenderer::PreprocessSeconds() const { return state_->preprocessSeconds; }
double PassRenderer::RenderSeconds() const { return state_->renderSeconds; }

bool PassRenderer::Run(const RenderPass& pass, const Sampler& sampler, Film* film) {
  using Clock = std::chrono::steady_clock;
  const auto secondsSince = [](Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
  };
  State& state = *state_;
  const Clock::time_point start = Clock::now();
  for (Worker& worker : state.workers) worker.threadState.Reset();
  try {
    if (state.preparedSeed != pass.preprocessSeed)
      state.Preprocess(pass.preprocessSeed, state.job.progress);
    state.preparedSeed = pass.preprocessSeed;
  } catch (const PreprocessStopped&) {
    state.job.progress.End();
    state.wasStopped = true;
    return false;
  }
  ++state.passes;
  state.preprocessSeconds = secondsSince(start);

  const Clock::time_point renderStart = Clock::now();
  std::optional<SplatBuffer> buffer;
  if (state.splatWeights) buffer.emplace(*state.splatWeights, film, state.options.aovs);
  SplatBuffer* const splats = buffer ? &*buffer : nullptr;
  const PixelBounds window = splats ? splats->Window() : film->Crop();
  if (state.sharing.isOn) {
    const int reach = splats ? state.splatWeights->Reach() : 0;
    GatherFragments gathers(Enlarged(window, film->Full(), reach), pass.sampleCount);
    state.RenderPixels({pass, sampler, *film, state.job.progress, &gathers, splats},
                       gathers.Bounds());
    state.ShareGathers(gathers, {film, state.options.aovs, splats});
  } else {
    state.RenderPixels({pass, sampler, *film, state.job.progress, nullptr, splats}, window);
  }
  if (splats) splats->Finish();
  state.renderSeconds = secondsSince(renderStart);
  state.totals.AddLight(*film, pass.sampleCount);
  return std::none_of(state.workers.begin(), state.workers.end(),
                      [](const Worker& worker) { return worker.wasStopped; });
}

RenderResult PassRenderer::Finish() {
  RenderTotals totals = state_->totals;
  for (const Worker& worker : state_->workers) totals.Add(worker.totals);
  RenderResult result = Summarize(state_->job, totals, state_->nonFinite);
  for (const Worker& worker : state_->workers) result.isComplete &= !worker.wasStopped;
  result.isComplete &= !state_->wasStopped;
  return result;
}

RenderResult Render(const RenderJob& job, const RenderOptions& options) {
  PassRenderer renderer(job, options);
  renderer.Run({options.seed, options.seed, 0, job.sampler.SamplesPerPixel()}, job.sampler,
               &job.film);
  return renderer.Finish();
}

}  // namespace exphoton
