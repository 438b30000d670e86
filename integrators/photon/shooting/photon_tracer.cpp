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

// Of the paths that are probably needed, at most this share is spent on one round of training.
constexpr double kMaxTrainingShare = .125;
// One round of training uses at most 1 / kMaxTrainingOfLimit of the paths that the limit leaves.
constexpr std::int64_t kMaxTrainingOfLimit = 8;
// Fewer paths that kept photons do not show where photons start.
constexpr std::int64_t kMinKeptPaths = 16;
// If more of the paths keep indirect photons without a guide, the indirect map needs none.
constexpr double kMaxUnguidedYield = .125;
// A map that needs fewer further paths than this without a guide needs none.
constexpr std::int64_t kMinUnguidedPaths = std::int64_t(1) << 17;
// Where a caustic is as bright as the indirect light, its estimates need disks whose radius is this
// number of times smaller than in the indirect map. Brighter caustics are resolved more finely.
constexpr double kCausticDetail = 4;
// Fewer photons do not make a map.
constexpr std::int64_t kMinCaustics = 1000;
// Share of the paths that the guide spreads over all emission.
constexpr double kDefensiveShare = .2;
// For the indirect map, whose paths leave direct photons too. Few of them may lie where nothing is
// reflected any further, or maxdist would follow these.
constexpr double kDefensiveIndirectShare = .05;

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

// Returns the sum of the luminances.
double PowerOf(std::span<const PhotonRecord> photons) {
  double sum = 0;
  for (const PhotonRecord& photon : photons) sum += double(photon.power.Power().Y());
  return sum;
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

bool PhotonTracer::Pass::MayGuide(PhotonKind kind) const {
  return tracer_.settings_.guideEmission && targets_[kind] > 0 && !tracer_.lights_->IsEmpty() &&
         !tracer_.rejection_.IsInUse();
}

void PhotonTracer::Pass::KeepSamples() {
  for (const PhotonChunk& chunk : chunks_) {
    if (samples_.size() >= mostSamples_) return;
    samples_.insert(samples_.end(), chunk.samples.begin(), chunk.samples.end());
  }
}

std::int64_t PhotonTracer::Pass::KeptPaths(PhotonKind kind, std::size_t first) const {
  return std::ranges::count_if(
      std::span(samples_).first(std::min(first, samples_.size())),
      [kind](const EmissionSample& s) { return s.kept[std::size_t(kind)] > 0; });
}

EmissionGuide PhotonTracer::Pass::Learn(PhotonKind kind) const {
  const auto& lights = tracer_.scene_.Lights();
  std::vector<double> base;
  for (const auto& light : lights) base.push_back(double(tracer_.lights_->Pmf(*light)));
  // With --effects all, the exposure may be open although nothing moves.
  const Scene& scene = tracer_.scene_;
  const int unused = scene.Primitives().MovesWithin(scene.Exposure()) ? 0 : 1;
  const double defensive = kind == PhotonKind::Indirect ? kDefensiveIndirectShare : kDefensiveShare;
  return LearnEmission(samples_, {kind, base, defensive, EmissionNumbers::kDimensions - unused});
}

// Drops the photons of a map. The indirect map takes all other maps with it.
void PhotonTracer::Pass::Discard(PhotonKind kind) {
  const bool isAll = kind == PhotonKind::Indirect;
  for (std::size_t m = 0; m < kPhotonKindCount; ++m) {
    if (!isAll && m != std::size_t(kind)) continue;
    result_.buffers[m].photons = {};
    batch_.open[m] = targets_.counts[m] > 0;
  }
  if (isAll) result_.sites = {};
  for (Worker& worker : workers_)
    for (LightTally& light : worker.lights) {
      light.stored -= isAll ? light.stored : light.caustic;
      light.caustic = 0;
    }
}

// Returns whether guiding the photons of this map is possible now and worthwhile.
bool PhotonTracer::Pass::IsWanted(PhotonKind kind) {
  const bool isIndirect = kind == PhotonKind::Indirect;
  bool& mayGuide = isIndirect ? mayGuideIndirect_ : mayGuideCaustics_;
  if (!mayGuide || !(isIndirect ? batch_.open[std::size_t(kind)] : IsOnlyCausticOpen()))
    return false;
  const std::int64_t kept = KeptPaths(kind, kMaxSamples);
  const bool areTooFew = kept < kMinKeptPaths;
  if (areTooFew && samples_.size() < kMaxSamples) {  // wait for more samples
    attemptAt_ = 2 * result_.paths;
    mostSamples_ = kMaxSamples;
    return false;
  }
  mayGuide = false;  // decided once
  if (areTooFew || MaxTrainingPaths() < kMinTrainingPaths) return false;
  const double filled = Filled(std::size_t(kind));
  if (!(double(result_.paths) * (1 - filled) > double(kMinUnguidedPaths) * filled)) return false;
  return !isIndirect || double(kept) < kMaxUnguidedYield * double(samples_.size());
}

// Begins to guide photons if that is worthwhile, and returns whether it did. The indirect map comes
// first; the direct map shares its paths. Caustic photons are guided once no other map needs paths.
bool PhotonTracer::Pass::BeginToGuide() {
  if (!batch_.isRecorded || result_.paths < attemptAt_) return false;
  const auto kind = IsOnlyCausticOpen() ? PhotonKind::Caustic : PhotonKind::Indirect;
  const bool begins = IsWanted(kind);
  if (begins) Train(kind);
  if (result_.paths >= attemptAt_) mostSamples_ = kUsualSamples;  // no attempt waits for samples
  batch_.isRecorded = mayGuideIndirect_ || mayGuideCaustics_;
  if (!batch_.isRecorded) samples_ = {};
  return begins;
}

// Returns the largest number of paths in one round of training, so that the path limit leaves
// enough paths for the maps.
std::int64_t PhotonTracer::Pass::MaxTrainingPaths() const {
  return (tracer_.settings_.maxPhotonPaths - result_.paths) / kMaxTrainingOfLimit;
}

// Finds the number of caustic photons that are worth their time, from one round of training, and at
// most `wanted`.
// The radius of an estimate of irradiance E is the root of k Phi / (pi E), if all photons have
// power Phi. Let caustics and indirect light have the same E. Caustics are then resolved
// kCausticDetail times as finely if their photons are kCausticDetail^2 times as weak. More photons
// are shot only if the user asks for a number.
void PhotonTracer::Pass::LimitCaustics(std::int64_t wanted, std::int64_t trainedPaths) {
  PhotonBuffer& indirect = result_[PhotonKind::Indirect];
  if (indirect.photons.Size() == 0) return;
  const double perIndirect = PowerOf(indirect.photons.Records()) / double(indirect.paths) /
                             double(indirect.photons.Size());
  double power = 0;
  for (const PhotonChunk& chunk : chunks_) power += PowerOf(chunk.photons[kCaustic]);
  const double enough =
      kCausticDetail * kCausticDetail * power / double(trainedPaths) / perIndirect;
  const bool isLess = enough < double(wanted);
  result_.enoughCaustics =
      isLess ? std::min(std::max(std::int64_t(enough), kMinCaustics), wanted) : 0;
  const bool isChosen = isLess && !tracer_.settings_.causticPhotons;
  targets_.counts[kCaustic] = isChosen ? result_.enoughCaustics : wanted;
}

// Trains the guide in rounds of growing size. No photon may depend on the guide that sends it, or
// estimates would be biased: photons from before and from the training are dropped.
void PhotonTracer::Pass::Train(PhotonKind kind) {
  const std::int64_t wanted = targets_[kind];
  Discard(kind);
  // If enough of the first samples kept photons, the rest makes room for new samples.
  std::size_t used = kUsualSamples;
  while (used < kMaxSamples && KeptPaths(kind, used) < kMinKeptPaths) used *= 2;
  samples_.resize(std::min(samples_.size(), used));
  mostSamples_ = std::max(samples_.size(), kUsualSamples) + 3 * kUsualSamples;
  guide_ = Learn(kind);
  batch_.guide = &guide_;
  batch_.isDiscarded = batch_.isRecorded = true;
  for (std::int64_t paths = kMinTrainingPaths;; paths *= 2) {
    Trace(paths);
    std::int64_t stored = 0;
    for (const PhotonChunk& chunk : chunks_) {
      stored += std::int64_t(chunk.photons[std::size_t(kind)].size());
      result_.skipped += chunk.skipped;
    }
    result_.paths += paths;
    result_.guidedPaths += paths;
    result_.trainingPaths += paths;
    if (kind == PhotonKind::Caustic) LimitCaustics(wanted, paths);
    guide_ = Learn(kind);
    const double needed = double(targets_[kind]) * double(paths) / double(stored + 1);
    if (kMaxTrainingShare * needed < double(2 * paths) || 2 * paths > MaxTrainingPaths() ||
        samples_.size() >= mostSamples_)
      break;
  }
  batch_.isDiscarded = false;
  trainedPath_ = result_.paths;
  for (std::size_t m = 0; m < kPhotonKindCount; ++m)
    if (kind == PhotonKind::Indirect || m == std::size_t(kind)) {
      firstPaths_[m] = trainedPath_;
      result_.buffers[m].isGuided = true;
    }
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
