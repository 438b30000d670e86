// SPDX-License-Identifier: BSD-2-Clause
// PhotonTracer schedules the batches of photon paths. photon_path.cpp traces single paths.
#include "integrators/photon/shooting/photon_tracer.h"

#include <algorithm>
#include <limits>
#include <sstream>

#include "core/base/log.h"
#include "core/base/parallel.h"
#include "core/base/progress.h"
#include "integrators/photon/maps/photon_time.h"
#include "integrators/photon/shooting/photon_path.h"
#include "integrators/photon/shooting/tracer_pass.h"

namespace exphoton {

namespace {

// Returns the largest distance that the 8-bit code can represent; > 0. Eight scene radii leave room
// for specular chains.
Real FarthestDistance(const Scene& scene) {
  constexpr Real kRadii = 8;
  return std::max(kRadii * BoundingSphere(scene.WorldBounds()).radius,
                  std::numeric_limits<Real>::min());
}

// A targeted light needs fewer photons, in inverse proportion to the gain in density.
std::vector<double> ShareFactors(const Scene& scene, const DistantLightTargeting& targeting) {
  std::vector<double> factors(scene.Lights().size(), 1.0);
  if (targeting.IsEmpty()) return factors;
  for (std::size_t i = 0; i < factors.size(); ++i)
    if (scene.Lights()[i]->IsDistant()) factors[i] = 1 / std::max(targeting.Gain(), 1.0);
  return factors;
}

// Returns the share of paths that begin in media: by power, but at least kMinShare for both
// sources.
Real MediaShare(const Scene& scene, const MediaPhotons& media, const LightSampler& lights) {
  constexpr double kMinShare = .05;
  if (!media.Emit()) return 0;
  if (lights.IsEmpty()) return 1;
  double power = 0;
  for (const auto& light : scene.Lights()) power += UsablePower(*light);
  const double sum = power + media.EmittedPower();
  return Real(std::clamp(sum > 0 ? media.EmittedPower() / sum : .5, kMinShare, 1 - kMinShare));
}

}  // namespace

PhotonTracer::PhotonTracer(const Scene& scene, const PhotonSettings& settings, std::uint64_t seed,
                           DistantLightTargeting targeting, MediaPhotons media)
    : scene_(scene),
      settings_(settings),
      seed_(seed),
      exposure_(scene.Exposure()),
      shapesMove_(scene.Primitives().MovesWithin(exposure_)),
      targeting_(std::move(targeting)),
      media_(std::move(media)),
      lights_(MakeEmissionLightSampler(scene.Lights(), settings.lightSelection,
                                       ShareFactors(scene, targeting_))),
      mediaShare_(MediaShare(scene, media_, *lights_)),
      rejection_(settings.photonRoulette == PhotonRoulette::Constant
                     ? PhotonRejection(
                           {scene.Lights(), *lights_, double(mediaShare_), media_.EmittedPower()})
                     : PhotonRejection()),
      specularBoxes_(scene.Features().Needs(Feature::Specular) ? SpecularBoxes(scene)
                                                               : SpecularBoxes()),
      causticLights_(scene.Features().Needs(Feature::Specular) ? CausticLights(scene)
                                                               : CausticLights()),
      lobes_(scene.Features().Needs(Feature::Specular) ? LobeSet::All : LobeSet::NonSpecular),
      farthest_(FarthestDistance(scene)) {}

void PhotonTracer::FixTime(Real u) {
  const Real time = std::clamp(Lerp(u, exposure_.min, exposure_.max), exposure_.min, exposure_.max);
  exposure_ = {time, time};
}

std::uint8_t PhotonTracer::PayloadOf(PhotonKind kind, const Photon& photon, Real time) const {
  if (!KeepsTimes(kind)) return EncodeDistance(photon.distance);
  return EncodePhotonTime((time - exposure_.min) / (exposure_.max - exposure_.min));
}

void PhotonTracer::TraceChunk(std::int64_t firstPath, const PhotonBatch& batch, Worker* worker,
                              PhotonChunk* chunk, std::vector<LightTally>* lights) const {
  const PhotonPathSequences sequences(seed_, std::uint64_t(firstPath));  // chunks are aligned
  chunk->Clear();
  lights->resize(scene_.Lights().size());  // here, so that the memory is local to the thread
  for (int i = 0; i < kChunkPaths; ++i) {
    Path path(*this, sequences, std::uint64_t(firstPath + i), {batch, chunk, &worker->branches});
    worker->arena.Reset();
    path.Trace(&worker->arena, &worker->rays);
    path.AddTo(*lights);
  }
}

// Traces a batch of paths into the chunks.
void PhotonTracer::Pass::Trace(std::int64_t paths) {
  context_.CheckStop();
  chunks_.resize(std::size_t(paths / kChunkPaths));
  context_.threads.For(std::int64_t(chunks_.size()), [&](std::int64_t c, int worker) {
    TraceOrTake(result_.paths + c * kChunkPaths, &workers_[std::size_t(worker)],
                &chunks_[std::size_t(c)]);
  });
  if (batch_.isRecorded) KeepSamples();
}

// Training needs samples, which a memo does not have.
void PhotonTracer::Pass::TraceOrTake(std::int64_t firstPath, Worker* worker, PhotonChunk* chunk) {
  if (!memo_ || NeedsSamples() || !memo_->Take(firstPath, State(), chunk))
    return tracer_.TraceChunk(firstPath, batch_, worker, chunk, &worker->lights);
  worker->lights.resize(tracer_.scene_.Lights().size());
  for (const auto& [light, tally] : chunk->lights) worker->lights[std::size_t(light)].Add(tally);
}

// Returns whether a guide may still be trained on the paths that are traced now.
bool PhotonTracer::Pass::NeedsSamples() const {
  if (batch_.isDiscarded) return true;
  const bool mayTrain = (mayGuideIndirect_ && batch_.open[std::size_t(PhotonKind::Indirect)]) ||
                        (mayGuideCaustics_ && batch_.open[kCaustic]);
  return mayTrain && samples_.size() < mostSamples_;
}

ChunkState PhotonTracer::Pass::State() const { return {batch_.open, trainedPath_}; }

// Returns how full a map is: the larger of its shares of the photon target and of the path limit.
double PhotonTracer::Pass::Filled(std::size_t map) const {
  const double stored = double(result_.buffers[map].photons.Size()) / double(targets_.counts[map]);
  return std::max(stored, double(result_.paths) / double(tracer_.settings_.maxPhotonPaths));
}

// Closes the maps that are full or have used up their paths.
void PhotonTracer::Pass::CloseMaps() {
  most_ = 0;
  for (std::size_t m = 0; m < kPhotonKindCount; ++m) {
    if (targets_.counts[m] == 0) continue;
    PhotonBuffer& buffer = result_.buffers[m];
    bool& open = batch_.open[m];
    if (open) buffer.paths = result_.paths - firstPaths_[m];
    const auto stored = std::int64_t(buffer.photons.Size());
    const bool isFruitless = stored == 0 && buffer.paths >= kFruitlessPaths;
    open = open && stored < targets_.counts[m] &&
           result_.paths < tracer_.settings_.maxPhotonPaths && !isFruitless;
    const double filled = Filled(m);
    if (open) most_ = std::max(most_, filled);
  }
}

// The emptiest map decides. Caustic photons are often shot after all others, so that they count as
// half of the work.
double PhotonTracer::Pass::Done() const {
  double caustic = 1, others = 1;
  for (std::size_t m = 0; m < kPhotonKindCount; ++m) {
    if (!batch_.open[m]) continue;
    double& least = m == kCaustic ? caustic : others;
    least = std::min(least, Filled(m));
  }
  if (targets_.counts[kCaustic] == 0) return others;
  const bool isAlone = std::ranges::count(targets_.counts, 0) + 1 == std::ssize(targets_.counts);
  return isAlone ? caustic : (caustic + others) / 2;
}

void PhotonTracer::Pass::Begin() {
  mayGuideIndirect_ = MayGuide(PhotonKind::Indirect) && !(tracer_.mediaShare_ > 0);
  mayGuideCaustics_ = MayGuide(PhotonKind::Caustic);
  batch_.isRecorded = mayGuideIndirect_ || mayGuideCaustics_;
  context_.progress.Begin("Shooting photons", 1000);
}

// Traces a batch, and sets the size of the next one.
void PhotonTracer::Pass::MergeBatch(std::int64_t* batch) {
  Trace(*batch);
  Merge(chunks_, targets_, context_.threads, &result_);
  if (batch_.guide) result_.guidedPaths += *batch;
  CloseMaps();
  CountRays();
  *batch = NextBatch(*batch, result_.paths - trainedPath_, most_);
  done_ = std::max(done_, Done());
  context_.progress.SetDone(std::int64_t(1000 * done_));
  if (BeginToGuide()) *batch = kMaxBatchPaths;
}

void PhotonTracer::Pass::CountRays() {
  std::uint64_t rays = 0;
  for (const Worker& worker : workers_) rays += worker.rays.Total();
  context_.progress.CountRays(rays - shownRays_);
  shownRays_ = rays;
}

PhotonPassResult PhotonTracer::Pass::Run(ChunkMemo* memo) {
  memo_ = memo;
  if (tracer_.lights_->IsEmpty() && !tracer_.media_.Emit()) return std::move(result_);
  Begin();
  for (std::int64_t batch = kChunkPaths; std::ranges::count(batch_.open, true) > 0;)
    MergeBatch(&batch);
  context_.progress.End();
  for (const Worker& worker : workers_) {
    context_.statistics.AddRays(worker.rays);
    for (std::size_t i = 0; i < worker.lights.size(); ++i) result_.lights[i].Add(worker.lights[i]);
  }
  for (std::size_t i = 0; i < result_.lights.size(); ++i)
    if (tracer_.causticLights_.IsOutOfReach(int(i)))
      result_.outOfReach += result_.lights[i].skipped;
  return std::move(result_);
}

PhotonPassResult PhotonTracer::Shoot(const PhotonTargets& targets, PreprocessContext& context,
                                     ChunkMemo* memo) const {
  return Pass(*this, targets, context).Run(memo);
}

std::int64_t PhotonTracer::NextBatch(std::int64_t last, std::int64_t paths, double filled) {
  // A batch has at most half of the paths that the fullest map probably still needs, so that the
  // map is not overfilled.
  const double needed = filled > 0 ? double(paths) * (1 - filled) / filled : 0;
  std::int64_t most = kMaxBatchPaths;
  while (most < kMaxGrownBatchPaths && double(4 * most) <= needed) most *= 2;
  return std::min(2 * last, most);
}

}  // namespace exphoton
