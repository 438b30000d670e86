// SPDX-License-Identifier: BSD-2-Clause
// PassRenderer: preprocessing, the loop over tiles, and what follows when all pixels are rendered.
#include "core/render/render.h"

#include <algorithm>
#include <chrono>
#include <deque>
#include <optional>

#include "core/render/render_totals.h"
#include "core/render/sharing/sharing_bands.h"
#include "core/render/sharing/sharing_plan.h"
#include "core/render/splat_buffer.h"
#include "core/render/state/pass_state.h"
#include "core/render/tile_renderer.h"
#include "core/render/tiles.h"

namespace exphoton {
struct PassRenderer::State {
  State(const RenderJob& aJob, const RenderOptions& someOptions)
      : job(aJob),
        options(someOptions),
        splatWeights(SplatWeights::Of(job.filter)),
        sharing(PlanSharing(job.integrator, job.scene, job.camera)) {
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

  // Renders the pixels of the window that are not done. The window has all columns of the pass.
  void RenderPixels(const TileRenderer::Target& target, const PixelBounds& window,
                    PassState* pass) {
    const PhaseTimer timer(job.statistics, "render");
    const Tiles tiles(window, options);
    const TileRenderer renderer(job, options, target, &nonFinite);
    const auto open = [&] { return target.done->CountOpen(window.y0, window.y1); };
    for (bool goesOn = true; goesOn;) {
      job.threads.For(tiles.Count(), [&](std::int64_t number, int worker) {
        renderer.RenderTile(tiles.Get(number), &workers[std::size_t(worker)]);
      });
      goesOn = !IsStopped() && open() > 0;  // the threads paused
      if (open() > 0) TakeCheckpoint(pass);
    }
    for (RenderWorker& worker : workers) worker.EndPartialPixel(target.splats != nullptr);
  }

  // Renders the pixels band by band. A band gets its shared light as soon as the gathers of its
  // pixels and of a margin about them are there.
  void RenderShared(const TileRenderer::Target& target, SharingBands* bands, PassState* pass) {
    for (; !bands->IsAtEnd(); bands->GoToNext()) {
      RenderPixels(target, bands->Current().gathered, pass);
      const PhaseTimer timer(job.statistics, "share");
      bands->AddLight(&job.threads, {&target.film, options.aovs, target.splats,
                                     bands->Current().window, double(target.pass.sampleCount)});
      if (IsStopped()) break;
    }
    job.statistics.SetCounter("render/sharing radius", bands->Totals().MeanRadius(),
                              "pixels, mean radius of the windows of shared gathers");
  }

  // Renders a pass after its preprocessing.
  void RunPass(const RenderPass& pass, const Sampler& sampler, Film* film) {
    std::optional<SplatBuffer> buffer;
    if (splatWeights) buffer.emplace(*splatWeights, film, options.aovs);
    SplatBuffer* const splats = buffer ? &*buffer : nullptr;
    const PixelBounds window = splats ? splats->Window() : film->Crop();
    PixelBounds rendered = window;
    std::optional<SharingBands> bands;
    if (sharing.isOn) {
      rendered = WithSharingMargin(window, film->Full(), splats ? splatWeights->Reach() : 0);
      bands.emplace(window, rendered, pass.sampleCount, options.sharingMemory);
    }
    SharingBands* const shared = bands ? &*bands : nullptr;
    PassState passState({pass, film, options.aovs, splats, shared}, rendered);
    Resume(&passState);
    const TileRenderer::Target target{
        pass,   sampler,          *film, job.progress, shared ? &shared->Gathers() : nullptr,
        splats, &passState.Done()};
    if (options.pixelsBegun) *options.pixelsBegun = true;
    job.progress.Begin("Rendering", target.done->CountOpen(rendered.y0, rendered.y1));
    if (shared)
      RenderShared(target, shared, &passState);
    else
      RenderPixels(target, rendered, &passState);
    job.progress.End();
    if (splats) splats->Finish();
    if (shared)
      if (const auto bias = EstimateSharingBias(shared->Totals().checked, *film))
        totals.AddSharingBias(*bias, pass.sampleCount);
    if (options.view && (shared || splats)) options.view->Show(*film, film->Crop());
  }

  // The first pass continues where a stopped render was, if there is one.
  void Resume(PassState* pass) {
    if (!options.resumed || passes > 1) return;
    if (PassState::IsIn(*options.resumed)) pass->Load(*options.resumed);
    const DonePixels& done = pass->Done();
    job.log.Notice("continuing \"" + options.resumed->Path() +
                   "\": " + std::to_string(100 * done.Count() / done.Total()) +
                   " % of the pixels are rendered");
    options.resumed->Release();
  }

  // `pass` is null if the pass was stopped before its first pixel.
  void TakeCheckpoint(PassState* pass) {
    if (!options.checkpoints) return;
    Checkpoint checkpoint;
    checkpoint.hasWork = pass && pass->Done().Count() > 0;
    checkpoint.save = [&](StateWriter* writer) {
      SaveTotals(writer);
      if (pass) pass->Save(writer);
    };
    if (pass) checkpoint.picture = [&, pass] { return pass->Picture(&job.threads); };
    options.checkpoints->Take(checkpoint, wasStopped || IsStopped());
  }

  void SaveTotals(StateWriter* writer) {
    RenderTotals all = totals;
    for (const RenderWorker& worker : workers) all.Add(worker.wholeTotals);
    SaveSection("totals", all, writer);
    SaveSection("non-finite samples", nonFinite, writer);
  }

  bool IsStopped() const {
    return std::any_of(workers.begin(), workers.end(),
                       [](const RenderWorker& worker) { return worker.wasStopped; });
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
  std::deque<RenderWorker> workers;
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
  if (!options.resumed) return;
  LoadSection("totals", &state_->totals, *options.resumed);
  LoadSection("non-finite samples", &state_->nonFinite, *options.resumed);
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
  for (RenderWorker& worker : state.workers) worker.threadState.Reset();
  try {
    if (state.preparedSeed != pass.preprocessSeed)
      state.Preprocess(pass.preprocessSeed, state.job.progress);
    state.preparedSeed = pass.preprocessSeed;
  } catch (const PreprocessStopped&) {
    state.job.progress.End();
    state.wasStopped = true;
    state.TakeCheckpoint(nullptr);
    return false;
  }
  ++state.passes;
  state.preprocessSeconds = secondsSince(start);

  const Clock::time_point renderStart = Clock::now();
  state.RunPass(pass, sampler, film);
  state.renderSeconds = secondsSince(renderStart);
  state.totals.AddLight(*film, pass.sampleCount);
  return !state.IsStopped();
}

void PassRenderer::SaveTotals(StateWriter* writer) const { state_->SaveTotals(writer); }

RenderResult PassRenderer::Finish() {
  RenderTotals totals = state_->totals;
  for (const RenderWorker& worker : state_->workers) totals.Add(worker.totals);
  RenderResult result = Summarize(state_->job, totals, state_->nonFinite);
  for (const RenderWorker& worker : state_->workers) result.isComplete &= !worker.wasStopped;
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
