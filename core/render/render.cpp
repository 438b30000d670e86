// SPDX-License-Identifier: BSD-2-Clause
// PassRenderer: preprocessing, the loop over tiles, and what follows when all pixels are rendered.
#include "core/render/render.h"

#include <algorithm>
#include <chrono>
#include <deque>
#include <optional>
#include <span>

#include "core/base/memory.h"
#include "core/render/pass_buffers.h"
#include "core/render/render_totals.h"
#include "core/render/shards/shard_writer.h"
#include "core/render/sharing/sharing_plan.h"
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

  void Preprocess(const RenderPass& pass, ProgressReporter& progress) {
    Log& log = passes == 0 ? job.log : mutedLog;
    const PixelBounds& full = job.film.Full();
    PreprocessContext context{job.threads,
                              pass.preprocessSeed,
                              log,
                              progress,
                              job.statistics,
                              options.isStrict,
                              &job.camera,
                              {full.Width(), full.Height()},
                              job.volume,
                              Stop(),
                              options.photonFile,
                              pass.diskArea,
                              pass.time};
    // The integrator may march through media while it prepares.
    if (job.volume) job.volume->Preprocess(job.scene);
    job.integrator.Preprocess(job.scene, context);
  }

  // Returns the batch of a pass, or null if its gathers are shared alone. Gathers beyond the memory
  // of a batch begin a new one.
  GatherBatch* BatchOf(const RenderPass& pass, const Film& film) {
    if (!sharing.isOn || options.shard || pass.sharing == RenderPass::Sharing::Alone)
      return nullptr;
    const double memory = kBandsOfPasses * options.sharingMemory;
    const std::int64_t before = batch ? batch->SamplesPerPixel() : 0;
    const bool isTooLarge = !GatherBatch::Fits(film.Full(), before + pass.sampleCount, memory);
    if (isTooLarge && !isBatchLimitLogged) {
      isBatchLimitLogged = true;
      job.log.Notice("gathers of several passes are shared together up to " + Megabytes(memory) +
                     ", those of larger passes alone");
    }
    if (isTooLarge || pass.sharing == RenderPass::Sharing::BeginsBatch) EndBatch();
    if (!GatherBatch::Fits(film.Full(), pass.sampleCount, memory)) return nullptr;
    if (!batch) MakeBatch(film);
    batch->ForgetFit();
    return &*batch;
  }

  // Adds the bias of the batch to the totals. They have it only now, because its estimate takes
  // time, and is of all passes of the batch.
  void EndBatch() {
    if (batch && batch->SamplesPerPixel() > 0) {
      const PhaseTimer timer(job.statistics, "share");
      if (const auto bias = batch->Bias(&job.threads))
        totals.AddSharingBias(*bias, batch->SamplesPerPixel());
    }
    batch.reset();
  }

  void MakeBatch(const Film& film) {
    const PassBuffers::Layout layout = LayoutOf({}, nullptr);
    batch.emplace(GatherBatch::Layout{film, options.aovs, PassBuffers::Window(layout, film),
                                      PassBuffers::Rendered(layout, film), splatWeights.get()});
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
  void RenderShared(const TileRenderer::Target& target, PassBuffers* buffers, PassState* pass) {
    SharingBands* const bands = buffers->Bands();
    for (; !bands->IsAtEnd(); bands->GoToNext()) {
      RenderPixels(target, bands->Current().gathered, pass);
      const bool isStopped = IsStopped();
      buffers->AddSharedLight(!isStopped, &job.threads, &job.statistics);
      if (isStopped) break;
    }
  }

  // Returns the emitters whose light is averaged over places of the film. Null: none. Passes share
  // them, so the specular trees that look for reflected emitters are traced once in each pixel.
  const StillEmitters* EmittersIn(const Film& film) {
    const std::optional<int> depth = job.integrator.EmissionDepth();
    // Splatted samples contribute to other pixels as well, by their own place.
    if (splatWeights || !depth || !job.integrator.HasCostlySamples()) return nullptr;
    if (!stillEmitters || !stillEmitters->AreOf(film))
      stillEmitters.emplace(FilmView{job.scene, job.camera, job.filter, film}, *depth);
    return &*stillEmitters;
  }

  // Returns the pixels that get more samples. Null: none do. Passes share them.
  const EdgePixels* EdgesIn(const PixelBounds& window) {
    if (job.integrator.EdgeSamples() == 1) return nullptr;
    if (!edges || edges->Window() != window)
      edges.emplace(job.scene, job.camera, job.filter, window);
    return &*edges;
  }

  PassBuffers::Layout LayoutOf(const RenderPass& pass, GatherBatch* passBatch) const {
    return {splatWeights.get(), sharing.isOn,        pass.sampleCount, options.sharingMemory,
            passBatch,          options.corrections, pass.diskArea,    options.sharingChange,
            pass.gathers};
  }

  ShardLayout ShardLayoutOf(const RenderPass& pass, const Film& film) const {
    ShardLayout layout;
    layout.full = film.Full();
    layout.crop = film.Crop();
    if (options.aovs) layout.aovs = options.aovs->Wanted();
    layout.samplesPerPixel = pass.sampleCount;
    layout.isShared = sharing.isOn;
    layout.isSplatted = splatWeights != nullptr;
    return layout;
  }

  // Returns the first tiles, in whole rows, whose gathers fit into options.sharingMemory.
  // `rowBytes` is the memory for one row of the shard's pixels.
  std::span<const ShardTile> FirstRows(std::span<const ShardTile> tiles, double rowBytes) const {
    const int top = tiles.front().bounds.y0;
    const auto isTooLow = [&](const ShardTile& tile) {
      return sharing.isOn && tile.bounds.y0 > top &&
             rowBytes * (tile.bounds.y1 - top) > options.sharingMemory;
    };
    const auto end = std::find_if(tiles.begin(), tiles.end(), isTooLow);
    return tiles.first(std::size_t(end - tiles.begin()));
  }

  // Renders the tiles of a shard in rows of tiles, so that only the gathers of some rows are in
  // memory at once.
  void RunShardPass(const RenderPass& pass, const Sampler& sampler, Film* film) {
    ShardWriter& writer = *options.shard;
    writer.BeginPass(ShardLayoutOf(pass, *film));
    const PixelBounds rendered = PassBuffers::Rendered(LayoutOf(pass, nullptr), *film);
    const std::vector<ShardTile> tiles = TilesOf(writer.Of(), rendered);
    std::optional<SplatBuffer> splats;
    if (splatWeights) splats.emplace(*splatWeights, film, options.aovs);
    std::optional<GatherFragments> gathers;
    DonePixels done(rendered);
    TileRenderer::Target target{pass,
                                sampler,
                                *film,
                                job.progress,
                                nullptr,
                                splats ? &*splats : nullptr,
                                &done,
                                EmittersIn(*film),
                                EdgesIn(rendered),
                                totals.SamplesPerPixel()};
    const double rowBytes =
        GatherFragments::BytesPerPixel(pass.sampleCount) * rendered.Width() / writer.Of().count;
    if (options.pixelsBegun) *options.pixelsBegun = true;
    job.progress.Begin("Rendering", CountPixels(tiles));
    for (std::span<const ShardTile> open = tiles; !open.empty() && !IsStopped();) {
      const std::span<const ShardTile> part = FirstRows(open, rowBytes);
      PixelBounds rows = rendered;
      rows.y0 = part.front().bounds.y0;
      rows.y1 = part.back().bounds.y1;
      if (sharing.isOn) target.gathers = &gathers.emplace(rows, 1);
      RenderTiles(target, part);
      if (IsStopped()) break;
      for (const ShardTile& tile : part)
        writer.AddTile(tile, film, {options.aovs, target.gathers, options.corrections});
      open = open.subspan(part.size());
    }
    job.progress.End();
    if (IsStopped()) return;
    if (splats) writer.AddSplats(*splats, film->Crop());
    writer.EndPass(job.statistics, AllTotals(), &nonFinite);
  }

  void RenderTiles(const TileRenderer::Target& target, std::span<const ShardTile> tiles) {
    const PhaseTimer timer(job.statistics, "render");
    const TileRenderer renderer(job, options, target, &nonFinite);
    job.threads.For(std::int64_t(tiles.size()), [&](std::int64_t number, int worker) {
      renderer.RenderTile(tiles[std::size_t(number)].bounds, &workers[std::size_t(worker)]);
    });
  }

  // Renders a pass after its preprocessing.
  void RunPass(const RenderPass& pass, const Sampler& sampler, Film* film) {
    if (options.shard) return RunShardPass(pass, sampler, film);
    GatherBatch* const passBatch = BatchOf(pass, *film);
    PassBuffers buffers(LayoutOf(pass, passBatch), film, options.aovs);
    const PixelBounds rendered = PassBuffers::Rendered(LayoutOf(pass, passBatch), *film);
    SharingBands* const shared = buffers.Bands();
    PassState passState({pass, film, options.aovs, buffers.Splats(), shared, options.corrections},
                        rendered);
    Resume(&passState);
    const TileRenderer::Target target{pass,
                                      sampler,
                                      *film,
                                      job.progress,
                                      buffers.Gathers(),
                                      buffers.Splats(),
                                      &passState.Done(),
                                      EmittersIn(*film),
                                      EdgesIn(rendered),
                                      totals.SamplesPerPixel()};
    if (options.pixelsBegun) *options.pixelsBegun = true;
    job.progress.Begin("Rendering", target.done->CountOpen(rendered.y0, rendered.y1));
    if (shared)
      RenderShared(target, &buffers, &passState);
    else
      RenderPixels(target, rendered, &passState);
    job.progress.End();
    const auto bias = buffers.Finish(&job.threads, &job.statistics);
    if (bias && !IsStopped()) totals.AddSharingBias(*bias, pass.sampleCount);
    if (options.view && (shared || buffers.Splats())) options.view->Show(*film, film->Crop());
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

  RenderTotals AllTotals() const {
    RenderTotals all = totals;
    for (const RenderWorker& worker : workers) all.Add(worker.wholeTotals);
    return all;
  }

  void SaveTotals(StateWriter* writer) {
    RenderTotals all = AllTotals();
    SaveSection("totals", all, writer);
    SaveSection("non-finite samples", nonFinite, writer);
    if (batch) batch->Save(writer);
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
  SharingPlan sharing;
  std::optional<StillEmitters> stillEmitters;  // of the last film
  std::optional<EdgePixels> edges;             // of the last window
  std::deque<RenderWorker> workers;
  bool wasStopped = false;  // while preprocessing
  NonFiniteLog nonFinite;
  std::optional<GatherBatch> batch;  // of the last passes; nullopt: none
  bool isBatchLimitLogged = false;
  Log mutedLog{Log::Level::Quiet, Log::Sink::Memory};
  int passes = 0;
  RenderTotals totals;
  std::optional<std::uint64_t> preparedSeed;  // of the last preprocessing
  double preprocessSeconds = 0, renderSeconds = 0;
};

PassRenderer::PassRenderer(const RenderJob& job, const RenderOptions& options)
    : state_(std::make_unique<State>(job, options)) {
  state_->preparedSeed = options.preparedSeed;
  SampleLayout layout;
  layout.needsLens = job.scene.Features().Needs(Feature::Lens);
  layout.needsTime = job.scene.Features().Needs(Feature::Motion);
  job.integrator.RequestSamples(job.scene, job.sampler, &layout);
  for (int i = 0; i < job.threads.Count(); ++i) state_->workers.emplace_back(layout);
  if (!options.resumed) return;
  LoadSection("totals", &state_->totals, *options.resumed);
  LoadSection("non-finite samples", &state_->nonFinite, *options.resumed);
  if (!GatherBatch::IsIn(*options.resumed)) return;
  state_->MakeBatch(job.film);
  state_->batch->Load(*options.resumed, &job.threads);
}

PassRenderer::~PassRenderer() = default;

std::optional<SharingBias> PassRenderer::MeanSharingBias() const {
  return state_->AllTotals().MeanSharingBias();
}

void PassRenderer::StopSharing() {
  state_->sharing = {};
  state_->totals.DropSharingBias();
}

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
    if (state.preparedSeed != pass.preprocessSeed) state.Preprocess(pass, state.job.progress);
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
  const RenderJob& job = state_->job;
  state_->EndBatch();
  RenderTotals totals = state_->totals;
  for (const RenderWorker& worker : state_->workers) totals.Add(worker.totals);
  RenderResult result;
  result.nonFiniteSamples = totals.nonFinite;
  // The light of a shard says nothing about the picture.
  if (!state_->options.shard)
    result = Summarize({job.statistics, job.log, job.integratorName, job.integrator.DepthLimits()},
                       totals, state_->nonFinite);
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
