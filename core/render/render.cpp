// SPDX-License-Identifier: BSD-2-Clause
// The tile loop. A tile is only a unit of work. Every camera sample is a function of (seed, pixel,
// sample index). One thread adds up a pixel's samples in the order of their index.
#include "core/render/render.h"

#include <algorithm>
#include <chrono>
#include <deque>
#include <sstream>

#include "core/render/non_finite_log.h"
#include "core/render/sharing/shared_gathers.h"
#include "core/render/sharing/sharing_plan.h"
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
  RayCounters rays;
  std::int64_t cameraSamples = 0, nonFinite = 0, negative = 0;
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
      const std::uint64_t raysBefore = worker->rays.Total();
      for (int x = tile.x0; x < tile.x1; ++x)
        if (!RenderPixel({x, y}, worker)) return;
      target_.progress.CountRays(worker->rays.Total() - raysBefore);
      target_.progress.Advance(tile.Width());
    }
  }

 private:
  using Clock = std::chrono::steady_clock;

  bool Needs(Feature feature) const { return job_.scene.Features().Needs(feature); }
  bool IsStopped() const { return options_.stop && options_.stop->load(std::memory_order_relaxed); }

  // Returns false if rendering was stopped.
  bool RenderPixel(Point2i pixel, Worker* worker) const {
    if (!aovs_ || !aovs_->NeedsTime()) return RenderSamples(pixel, worker);
    const Clock::time_point start = Clock::now();
    const bool isDone = RenderSamples(pixel, worker);
    aovs_->AddTime(pixel, std::chrono::duration<double>(Clock::now() - start).count());
    return isDone;
  }

  bool RenderSamples(Point2i pixel, Worker* worker) const {
    worker->pixelState.Reset();
    const bool isWhole = RenderAllSamples(pixel, worker);
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
    const FilterSample filter = job_.filter.Sample(samples.film);
    const Point2 film =
        Point2(Real(key.pixel.x) + Real(.5), Real(key.pixel.y) + Real(.5)) + filter.offset;
    const RayDifferential ray = CameraRay(film, samples);

    worker->arena.Reset();
    LiContext context{job_.scene, samples, worker->arena, worker->rays,
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
    ++worker->cameraSamples;
    const Real alpha = std::isfinite(context.alpha) ? context.alpha : Real(1);
    for (const GatherRecord& gather : worker->gathers)
      if (!gather.IsFinite()) L += gather.light * gather.weight;  // not finite either
    if (!L.IsFinite()) {
      Drop(L, key, worker);
      L = Spectrum();
      Blacken(&aovs);
      worker->gathers.clear();
    } else if (L.MinComponent() < 0) {
      ++worker->negative;
      ClampNegative(&L, &aovs);
    }
    if (target_.gathers) {
      // Neighbouring samples and neighbouring pixels belong to different halves.
      const int half = int((key.index + key.pixel.x + key.pixel.y) & 1);
      target_.gathers->At(key.pixel).Add(worker->gathers, film, filter.weight, half);
      if (!target_.film.Crop().Contains(key.pixel.x, key.pixel.y)) return;
    }
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
    ++worker->nonFinite;
    log_->Add(key.pixel, key.index, text);
  }

  const RenderJob& job_;
  const RenderOptions& options_;
  Target target_;
  NonFiniteLog* log_;
  AovFilm* aovs_;
  Real differentialScale_;
};

// Warns if the depth limit cut more than kSilentShare of the throughput. The picture lacks this
// light.
void WarnOfCutPaths(const RenderJob& job, const RayCounters& rays, std::int64_t cameraSamples) {
  constexpr double kSilentShare = 1e-3;
  const auto warn = [&](double cut, double of, const std::string& what) {
    const double share = cut / std::max(of, 1.);
    if (!(share > kSilentShare)) return;
    std::ostringstream text;
    text.precision(2);
    text << "the depth limit cut specular paths that carry " << 100 * share << " % of what "
         << what;
    job.log.Warning(text.str(), {}, "raise \"maxdepth\" of the integrator");
  };
  warn(rays.cutThroughput, double(cameraSamples), "the camera could see");
  warn(rays.cutGatherThroughput, double(rays.counts[std::size_t(RayKind::Gather)]),
       "gather rays could see");
}

RenderResult Summarize(const RenderJob& job, const std::deque<Worker>& workers,
                       const NonFiniteLog& log) {
  RenderResult result;
  std::int64_t cameraSamples = 0, negative = 0;
  RayCounters rays;
  for (const Worker& worker : workers) {
    rays.Add(worker.rays);
    cameraSamples += worker.cameraSamples;
    negative += worker.negative;
    result.nonFiniteSamples += worker.nonFinite;
    result.isComplete &= !worker.wasStopped;
  }
  job.statistics.AddRays(rays);
  result.nonFiniteReports = log.Texts();
  job.statistics.SetCounter("render/camera samples", double(cameraSamples), "camera rays started");
  job.statistics.SetCounter("render/non-finite samples", double(result.nonFiniteSamples),
                            "camera samples dropped, counted as black");
  job.statistics.SetCounter("render/negative samples", double(negative),
                            "camera samples with a component below 0, taken as 0");
  WarnOfCutPaths(job, rays, cameraSamples);
  if (result.nonFiniteSamples == 0) return result;
  for (const std::string& text : result.nonFiniteReports)
    job.log.Warning("dropped a non-finite " + text);
  job.log.Warning(std::to_string(result.nonFiniteSamples) +
                  " non-finite camera samples were dropped and count as black");
  return result;
}

// Returns the pixels whose gathers the crop window needs.
PixelBounds Enlarged(const PixelBounds& crop, const PixelBounds& full) {
  const int margin = SharingMargin();
  return {std::max(crop.x0 - margin, full.x0), std::max(crop.y0 - margin, full.y0),
          std::min(crop.x1 + margin, full.x1), std::min(crop.y1 + margin, full.y1)};
}

}  // namespace

struct PassRenderer::State {
  State(const RenderJob& aJob, const RenderOptions& someOptions)
      : job(aJob),
        options(someOptions),
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

  void ShareGathers(const GatherFragments& gathers, Film* film) {
    const PhaseTimer timer(job.statistics, "share");
    const double radius = AddSharedLight(gathers, &job.threads, film, options.aovs);
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
  const SharingPlan sharing;
  std::deque<Worker> workers;
  bool wasStopped = false;  // while preprocessing
  NonFiniteLog nonFinite;
  Log mutedLog{Log::Level::Quiet, Log::Sink::Memory};
  int passes = 0;
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
    state.Preprocess(pass.preprocessSeed, state.job.progress);
  } catch (const PreprocessStopped&) {
    state.job.progress.End();
    state.wasStopped = true;
    return false;
  }
  ++state.passes;
  state.preprocessSeconds = secondsSince(start);

  const Clock::time_point renderStart = Clock::now();
  if (state.sharing.isOn) {
    GatherFragments gathers(Enlarged(film->Crop(), film->Full()), pass.sampleCount);
    state.RenderPixels({pass, sampler, *film, state.job.progress, &gathers}, gathers.Bounds());
    state.ShareGathers(gathers, film);
  } else {
    state.RenderPixels({pass, sampler, *film, state.job.progress, nullptr}, film->Crop());
  }
  state.renderSeconds = secondsSince(renderStart);
  return std::none_of(state.workers.begin(), state.workers.end(),
                      [](const Worker& worker) { return worker.wasStopped; });
}

RenderResult PassRenderer::Finish() {
  RenderResult result = Summarize(state_->job, state_->workers, state_->nonFinite);
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
