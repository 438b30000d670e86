// SPDX-License-Identifier: BSD-2-Clause
// The tile loop. A tile is only a unit of work: every camera sample is a function of (seed, pixel,
// sample index), and a pixel's sums are added by one thread in the order of the index.
#include "core/transport/render.h"

#include <deque>
#include <map>
#include <mutex>
#include <sstream>
#include <tuple>

namespace exphoton {
namespace {

constexpr std::size_t kReportsKept = 8;

// What one thread works with.
struct alignas(64) Worker {
  explicit Worker(const SampleLayout& layout) : samples(layout) {}

  CameraSamples samples;
  Arena arena;
  RayCounters rays;
  std::int64_t cameraSamples = 0, nonFinite = 0, negative = 0;
  bool wasStopped = false;
};

// The dropped samples that come first in scanline order, whichever thread met them first.
class NonFiniteLog {
 public:
  void Add(Point2i pixel, std::int64_t index, std::string text) {
    const std::lock_guard lock(mutex_);
    reports_.emplace(std::tuple(pixel.y, pixel.x, index), std::move(text));
    if (reports_.size() > kReportsKept) reports_.erase(std::prev(reports_.end()));
  }
  std::vector<std::string> Texts() const {
    std::vector<std::string> texts;
    for (const auto& report : reports_) texts.push_back(report.second);
    return texts;
  }

 private:
  std::mutex mutex_;
  std::map<std::tuple<int, int, std::int64_t>, std::string> reports_;
};

// The crop window cut into squares, numbered in the order in which they are rendered.
class Tiles {
 public:
  Tiles(const PixelBounds& crop, const RenderOptions& options)
      : crop_(crop), size_(std::max(options.tileSize, 1)), order_(options.tileOrder) {
    columns_ = (std::int64_t(crop.Width()) + size_ - 1) / size_;
    rows_ = (std::int64_t(crop.Height()) + size_ - 1) / size_;
  }
  std::int64_t Count() const { return columns_ * rows_; }
  PixelBounds Get(std::int64_t number) const {
    if (order_ == TileOrder::Reversed) number = Count() - 1 - number;
    const std::int64_t x = crop_.x0 + number % columns_ * size_;
    const std::int64_t y = crop_.y0 + number / columns_ * size_;
    return {int(x), int(y), int(std::min<std::int64_t>(x + size_, crop_.x1)),
            int(std::min<std::int64_t>(y + size_, crop_.y1))};
  }

 private:
  PixelBounds crop_;
  std::int64_t size_, columns_, rows_;
  TileOrder order_;
};

// Brings the neighbouring rays from a pixel's distance to the mean distance of a pixel's samples.
void ScaleDifferentials(RayDifferential* ray, Real scale) {
  ray->xOrigin = ray->o + (ray->xOrigin - ray->o) * scale;
  ray->yOrigin = ray->o + (ray->yOrigin - ray->o) * scale;
  ray->xDirection = ray->d + (ray->xDirection - ray->d) * scale;
  ray->yDirection = ray->d + (ray->yDirection - ray->d) * scale;
}

std::string Describe(const Spectrum& L, const SampleKey& key) {
  std::ostringstream text;
  text << "radiance (" << L.r << ", " << L.g << ", " << L.b << ") at pixel " << key.pixel.x << ","
       << key.pixel.y << ", sample " << key.index << ", seed " << key.seed;
  return text.str();
}

class TileRenderer {
 public:
  TileRenderer(const RenderJob& job, const RenderOptions& options, NonFiniteLog* log)
      : job_(job),
        options_(options),
        log_(log),
        samplesPerPixel_(job.sampler.SamplesPerPixel()),
        differentialScale_(
            Real(1 / std::sqrt(double(std::max<std::int64_t>(samplesPerPixel_, 1))))),
        needsFiltering_(job.scene.Effects().Needs(Effect::Filtering)),
        needsLens_(job.scene.Effects().Needs(Effect::Lens)),
        needsTime_(job.scene.Effects().Needs(Effect::Motion)) {}

  void RenderTile(const PixelBounds& tile, Worker* worker) const {
    for (int y = tile.y0; y < tile.y1; ++y) {
      for (int x = tile.x0; x < tile.x1; ++x)
        if (!RenderPixel({x, y}, worker)) return;
      job_.progress.Advance(tile.Width());
    }
  }

 private:
  bool IsStopped() const { return options_.stop && options_.stop->load(std::memory_order_relaxed); }

  // False where stopped.
  bool RenderPixel(Point2i pixel, Worker* worker) const {
    for (std::int64_t i = 0; i < samplesPerPixel_; ++i) {
      if (IsStopped()) {
        worker->wasStopped = true;
        return false;
      }
      RenderSample({options_.seed, pixel, i}, worker);
    }
    return true;
  }

  void RenderSample(const SampleKey& key, Worker* worker) const {
    CameraSamples& samples = worker->samples;
    job_.sampler.Generate(key, &samples);
    const FilterSample filter = job_.filter.Sample(samples.film);
    CameraSample sample;
    sample.film =
        Point2(Real(key.pixel.x) + Real(.5), Real(key.pixel.y) + Real(.5)) + filter.offset;
    sample.lens = needsLens_ ? samples.lens : Point2(Real(.5), Real(.5));
    sample.time = needsTime_ ? samples.time : 0;
    RayDifferential ray = job_.camera.GenerateRay(sample, needsFiltering_);
    if (ray.hasDifferentials) ScaleDifferentials(&ray, differentialScale_);

    worker->arena.Reset();
    LiContext context{job_.scene, samples, worker->arena, worker->rays,
                      HashKey({key.seed, std::uint64_t(key.pixel.x), std::uint64_t(key.pixel.y),
                               std::uint64_t(key.index)})};
    Spectrum L = job_.integrator.Li(ray, context);
    ++worker->cameraSamples;
    const Real alpha = std::isfinite(context.alpha) ? context.alpha : Real(1);
    if (!L.IsFinite()) {
      Drop(L, key, worker);
      L = Spectrum();
    } else if (L.MinComponent() < 0) {
      ++worker->negative;
      L = {std::max(L.r, Real(0)), std::max(L.g, Real(0)), std::max(L.b, Real(0))};
    }
    job_.film.AddSample(key.pixel, L, alpha, filter.weight);
  }

  void Drop(const Spectrum& L, const SampleKey& key, Worker* worker) const {
    const std::string text = Describe(L, key);
    if (options_.isStrict) throw Error(ExitStatus::Internal, "non-finite " + text);
    ++worker->nonFinite;
    log_->Add(key.pixel, key.index, text);
  }

  const RenderJob& job_;
  const RenderOptions& options_;
  NonFiniteLog* log_;
  std::int64_t samplesPerPixel_;
  Real differentialScale_;
  bool needsFiltering_, needsLens_, needsTime_;
};

void Preprocess(const RenderJob& job, const RenderOptions& options) {
  PreprocessContext context{job.threads, options.seed, job.log, job.progress, job.statistics};
  job.integrator.Preprocess(job.scene, context);
}

// A depth limit may cut a little without a word; more is light that the picture lacks.
void WarnOfCutPaths(const RenderJob& job, double cutThroughput, std::int64_t cameraSamples) {
  constexpr double kSilentShare = 1e-3;
  const double share = cutThroughput / double(std::max<std::int64_t>(cameraSamples, 1));
  if (!(share > kSilentShare)) return;
  std::ostringstream text;
  text.precision(2);
  text << "the depth limit cut specular paths that carry " << 100 * share
       << " % of what the camera could see";
  job.log.Warning(text.str(), {}, "raise \"maxdepth\" of the integrator");
}

RenderResult Summarize(const RenderJob& job, const std::deque<Worker>& workers,
                       const NonFiniteLog& log) {
  RenderResult result;
  std::int64_t cameraSamples = 0, negative = 0;
  double cutThroughput = 0;
  for (const Worker& worker : workers) {
    job.statistics.AddRays(worker.rays);
    cameraSamples += worker.cameraSamples;
    negative += worker.negative;
    cutThroughput += worker.rays.cutThroughput;
    result.nonFiniteSamples += worker.nonFinite;
    result.isComplete &= !worker.wasStopped;
  }
  result.nonFiniteReports = log.Texts();
  job.statistics.SetCounter("render/camera samples", double(cameraSamples), "camera rays started");
  job.statistics.SetCounter("render/non-finite samples", double(result.nonFiniteSamples),
                            "camera samples dropped, counted as black");
  job.statistics.SetCounter("render/negative samples", double(negative),
                            "camera samples with a component below 0, taken as 0");
  WarnOfCutPaths(job, cutThroughput, cameraSamples);
  if (result.nonFiniteSamples == 0) return result;
  for (const std::string& text : result.nonFiniteReports)
    job.log.Warning("dropped a non-finite " + text);
  job.log.Warning(std::to_string(result.nonFiniteSamples) +
                  " non-finite camera samples were dropped and count as black");
  return result;
}

}  // namespace

RenderResult Render(const RenderJob& job, const RenderOptions& options) {
  SampleLayout layout;
  job.integrator.RequestSamples(job.scene, job.sampler, &layout);
  Preprocess(job, options);

  const PhaseTimer timer(job.statistics, "render");
  std::deque<Worker> workers;
  for (int i = 0; i < job.threads.Count(); ++i) workers.emplace_back(layout);

  const Tiles tiles(job.film.Crop(), options);
  NonFiniteLog log;
  const TileRenderer renderer(job, options, &log);
  const PixelBounds& crop = job.film.Crop();
  if (options.pixelsBegun) *options.pixelsBegun = true;
  job.progress.Begin("Rendering", std::int64_t(crop.Width()) * crop.Height());
  job.threads.For(tiles.Count(), [&](std::int64_t number, int worker) {
    renderer.RenderTile(tiles.Get(number), &workers[std::size_t(worker)]);
  });
  job.progress.End();
  return Summarize(job, workers, log);
}

}  // namespace exphoton
