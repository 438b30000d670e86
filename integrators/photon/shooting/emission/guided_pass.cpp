// SPDX-License-Identifier: BSD-2-Clause
// This file learns where photons start, in the middle of a pass: whether a map is guided, the
// training of its guide, and the number of photons that are worth their paths.
#include <algorithm>

#include "integrators/photon/shooting/tracer_pass.h"
#include "integrators/photon/shooting/visible_points.h"

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

// These show a dark room that fills a thousandth of the picture.
constexpr std::uint32_t kManyCameraRays = 16 * kUsualCameraRays;

// Returns the sum of the luminances.
double PowerOf(std::span<const PhotonRecord> photons) {
  double sum = 0;
  for (const PhotonRecord& photon : photons) sum += double(photon.power.Power().Y());
  return sum;
}

}  // namespace

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
  // A map with fewer indirect photons (LimitIndirect) is no reason for fewer caustic ones.
  const double count =
      double(result_.enoughIndirect > 0 ? wantedIndirect_ : std::int64_t(indirect.photons.Size()));
  const double perIndirect = PowerOf(indirect.photons.Records()) / double(indirect.paths) / count;
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

// Returns direct and caustic photons of the paths so far, which are not guided; none: no place is
// known to matter, or only indirect photons are wanted. Where shapes move, photons and visible
// points are not in the same pose.
std::vector<SomePhotons> PhotonTracer::Pass::OtherPhotons() {
  const bool isAlone = targets_[PhotonKind::Direct] + targets_[PhotonKind::Caustic] == 0;
  if (!context_.camera || isAlone || tracer_.shapesMove_) return {};
  std::vector<SomePhotons> others;
  for (const PhotonKind kind : {PhotonKind::Direct, PhotonKind::Caustic}) {
    SomePhotons& photons = others.emplace_back();
    photons.Add(result_[kind].photons.Records());
    photons.AddPaths(result_[kind].paths);
  }
  return others;
}

IndirectShare PhotonTracer::Pass::ShareAtPoints(const std::vector<SomePhotons>& others,
                                                std::uint32_t cameraRays) const {
  IndirectShare share(VisiblePoints(tracer_.scene_, *context_.camera, context_.resolution,
                                    context_.seed, cameraRays));
  for (const SomePhotons& photons : others)
    share.AddLight(tracer_.scene_, photons, context_.threads);
  return share;
}

// Finds the number of indirect photons that are worth their time, from one round of training. Only
// many points show that no dark room is among them, and they are sought where few points see none.
// Rare heavy photons make most estimates too low, so the largest one of all rounds counts.
void PhotonTracer::Pass::LimitIndirect(const std::vector<SomePhotons>& others,
                                       std::int64_t trainedPaths) {
  SomePhotons photons;
  photons.AddPaths(trainedPaths);
  for (const PhotonChunk& chunk : chunks_) photons.Add(chunk.photons[kIndirect]);
  if (!photons.AreMany()) return;
  const auto bound = [&] { return share_->UpperBound(photons, context_.threads); };
  if (!share_) {
    share_ = ShareAtPoints(others, kUsualCameraRays);
    if (EnoughIndirectPhotons(bound(), wantedIndirect_) < wantedIndirect_)
      share_ = ShareAtPoints(others, kManyCameraRays);
  }
  indirectShare_ = std::max(indirectShare_, bound());
  const std::int64_t enough = EnoughIndirectPhotons(indirectShare_, wantedIndirect_);
  targets_[PhotonKind::Indirect] = enough;
  result_.enoughIndirect = enough < wantedIndirect_ ? enough : 0;
}

// Trains the guide in rounds of growing size. No photon may depend on the guide that sends it, or
// estimates would be biased: photons from before and from the training are dropped.
void PhotonTracer::Pass::Train(PhotonKind kind) {
  const std::int64_t wanted = targets_[kind];
  const bool isIndirect = kind == PhotonKind::Indirect;
  const auto others = isIndirect ? OtherPhotons() : std::vector<SomePhotons>();
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
    if (!others.empty()) LimitIndirect(others, paths);
    guide_ = Learn(kind);
    const double needed = double(targets_[kind]) * double(paths) / double(stored + 1);
    if (kMaxTrainingShare * needed < double(2 * paths) || 2 * paths > MaxTrainingPaths() ||
        samples_.size() >= mostSamples_)
      break;
  }
  batch_.isDiscarded = false;
  trainedPath_ = result_.paths;
  for (std::size_t m = 0; m < kPhotonKindCount; ++m)
    if (isIndirect || m == std::size_t(kind)) {
      firstPaths_[m] = trainedPath_;
      result_.buffers[m].isGuided = true;
    }
}

}  // namespace exphoton
