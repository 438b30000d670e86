// SPDX-License-Identifier: BSD-2-Clause
// TileRenderer renders the samples of the pixels of a tile. Every camera sample is a function of
// (seed, pixel, sample index). One thread adds up a pixel's samples in the order of their index.
#pragma once

#include "core/render/done_pixels.h"
#include "core/render/edges/edge_pixels.h"
#include "core/render/emitters/moving_emitters.h"
#include "core/render/emitters/still_emitters.h"
#include "core/render/render.h"
#include "core/render/render_totals.h"
#include "core/render/sharing/gather_fragments.h"
#include "core/render/splat_buffer.h"
#include "core/render/state/checkpoints.h"

namespace exphoton {

// The state of one thread. The alignment of its Arena keeps workers on separate cache lines.
struct RenderWorker {
  explicit RenderWorker(const SampleLayout& layout) : samples(layout) {}

  // Adds the samples of the pixel that was not finished to the picture, if there is one.
  void EndPartialPixel(bool isSplatted) {
    if (isSplatted && wasStopped) splat.End();
  }

  CameraSamples samples;
  Arena arena;
  GatherRecords gathers;
  PixelState pixelState;
  ThreadState threadState;
  SplatBuffer::Pixel splat;
  RenderTotals totals;
  RenderTotals wholeTotals;  // without the pixel that is not finished
  bool wasStopped = false;
};

class TileRenderer {
 public:
  struct Target {
    const RenderPass& pass;
    const Sampler& sampler;
    Film& film;
    ProgressReporter& progress;
    GatherFragments* gathers;            // null if gathers are not shared
    SplatBuffer* splats;                 // null if samples contribute to their own pixels only
    DonePixels* done;                    // pixels that are left out; receives the finished ones
    const StillEmitters* stillEmitters;  // whose light is averaged over places; null: none
    const EdgePixels* edges;             // pixels with more samples; null: none
    std::int64_t samplesBefore = 0;      // per pixel, of earlier passes
  };

  // All arguments must outlive this object.
  TileRenderer(const RenderJob& job, const RenderOptions& options, const Target& target,
               NonFiniteLog* log);

  // Returns early if the render is stopped or paused.
  void RenderTile(const PixelBounds& tile, RenderWorker* worker) const;

 private:
  bool Needs(Feature feature) const { return job_.scene.Features().Needs(feature); }
  bool IsStopped() const { return options_.stop && options_.stop->load(std::memory_order_relaxed); }
  bool IsPaused() const { return options_.checkpoints && options_.checkpoints->IsDue(); }

  // These return false if rendering was stopped or paused.
  bool RenderRow(const PixelBounds& tile, int y, RenderWorker* worker) const;
  bool RenderPixel(Point2i pixel, RenderWorker* worker) const;
  bool RenderSamples(Point2i pixel, RenderWorker* worker) const;
  bool RenderAllSamples(Point2i pixel, RenderWorker* worker) const;

  // Renders a sample of a pixel whose samples are divided into `parts` each.
  void RenderSample(const SampleKey& key, int parts, RenderWorker* worker) const;
  // Begins a sample: clears the worker's data of the last one.
  LiContext MakeContext(const SampleKey& key, int parts, RenderWorker* worker) const;
  static void Count(const LiContext& context, RenderTotals* totals);
  // What a sample says about the errors of the picture.
  struct ErrorSample {
    CorrectionSample correction;
    Spectrum signedLight;
  };
  void RequestErrors(LiContext* context, ErrorSample* errors) const;
  void AddErrors(Point2i pixel, const ErrorSample& errors, Real weight) const;
  CameraSample AtPlace(Point2 film, const CameraSamples& samples) const;
  RayDifferential CameraRay(const CameraSample& sample) const;
  RayDifferential CameraRay(Point2 film, const CameraSamples& samples) const {
    return CameraRay(AtPlace(film, samples));
  }
  // Returns a sample's place on the film.
  static Point2 PlaceOf(Point2i pixel, const FilterSample& filter) {
    return Point2(Real(pixel.x) + Real(.5), Real(pixel.y) + Real(.5)) + filter.offset;
  }
  // A camera sample: its pixel, its place in the filter, its ray and its context.
  struct TracedSample {
    Point2i pixel;
    const FilterSample& filter;
    const RayDifferential& ray;
    const LiContext& context;
    std::uint64_t specularRays;  // of the thread, before the sample
  };
  static std::uint64_t SpecularRays(const RenderWorker& worker) {
    return worker.totals.rays.counts[std::size_t(RayKind::Specular)];
  }
  // Replaces the light of moving emitters in L by the mean over several times.
  void AverageTimes(const TracedSample& sample, RenderWorker* worker, Spectrum* L,
                    AovSample* aovs) const;
  // Replaces the light of still emitters in L by the mean over several places in the filter.
  void AveragePlaces(const TracedSample& sample, RenderWorker* worker, Spectrum* L,
                     AovSample* aovs) const;
  // Returns the light of the tiny emitters in the sample's pixel, from places in their boxes.
  Spectrum TinyLight(const TracedSample& sample, RenderWorker* worker) const;
  // Adds the light of one of them, through the worker's point of the lens.
  void AddLight(const TinyEmitters::Emitter& emitter, const TracedSample& sample,
                RenderWorker* worker, Spectrum* light) const;
  // Traces a few specular trees in the pixel. Returns the number of rays of one tree, or 0 if they
  // meet no still emitter. These rays are not counted. The result is the same in all passes.
  int RaysOfReflection(Point2i pixel, RenderWorker* worker) const;
  void MakeUsable(const SampleKey& key, RenderWorker* worker, Spectrum* L, AovSample* aovs) const;
  void Drop(const Spectrum& L, const SampleKey& key, RenderWorker* worker) const;

  const RenderJob& job_;
  const RenderOptions& options_;
  Target target_;
  NonFiniteLog* log_;
  AovFilm* aovs_;
  double pixels_;  // of the picture
  Real differentialScale_;
  std::unique_ptr<const Sampler> edgeSampler_;  // of pixels on edges; null: as in other pixels
  MovingEmitters movingEmitters_;
};

}  // namespace exphoton
