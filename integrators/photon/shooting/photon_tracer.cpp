// SPDX-License-Identifier: BSD-2-Clause
// PhotonTracer schedules the batches of photon paths. photon_path.cpp traces single paths.
#include "integrators/photon/shooting/photon_tracer.h"

#include <algorithm>
#include <limits>
#include <sstream>

#include "core/base/log.h"
#include "core/base/parallel.h"
#include "core/base/progress.h"
#include "integrators/photon/shooting/photon_chunk.h"
#include "integrators/photon/shooting/photon_path.h"

namespace exphoton {

struct PhotonTracer::Worker {
  Arena arena;
  std::vector<PhotonBranch> branches;
  RayCounters rays;
  std::vector<LightTally> lights;
};

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
      lobes_(scene.Features().Needs(Feature::Specular) ? LobeSet::All : LobeSet::NonSpecular),
      farthest_(FarthestDistance(scene)) {}

void PhotonTracer::TraceChunk(std::int64_t firstPath,
                              const std::array<bool, kPhotonKindCount>& open, Real radianceFraction,
                              Worker* worker, PhotonChunk* chunk) const {
  const PhotonPathSequences sequences(seed_, std::uint64_t(firstPath));  // chunks are aligned
  chunk->Clear();
  worker->lights.resize(scene_.Lights().size());  // here, so that the memory is local to the thread
  for (int i = 0; i < kChunkPaths; ++i) {
    Path path(*this, sequences, std::uint64_t(firstPath + i),
              {open, radianceFraction, chunk, &worker->branches});
    worker->arena.Reset();
    path.Trace(&worker->arena, &worker->rays);
    path.AddTo(worker->lights);
  }
}

namespace {

// Returns how full a map is: the larger of its shares of the photon target and of the path limit.
double Filled(const PhotonTargets& targets, const PhotonPassResult& result, std::size_t map,
              std::int64_t maxPaths) {
  const double stored = double(result.buffers[map].photons.Size()) / double(targets.counts[map]);
  return std::max(stored, double(result.paths) / double(maxPaths));
}

}  // namespace

PhotonPassResult PhotonTracer::Shoot(const PhotonTargets& targets,
                                     PreprocessContext& context) const {
  PhotonPassResult result;
  std::array<bool, kPhotonKindCount> open{};
  for (std::size_t m = 0; m < kPhotonKindCount; ++m) open[m] = targets.counts[m] > 0;
  result.lights.resize(scene_.Lights().size());
  for (PhotonBuffer& buffer : result.buffers) buffer.farthest = farthest_;
  if (lights_->IsEmpty() && !media_.Emit()) return result;

  std::vector<Worker> workers(std::size_t(context.threads.Count()));
  std::vector<PhotonChunk> chunks;
  context.progress.Begin("Shooting photons", 1000);
  for (std::int64_t batch = kChunkPaths; open[0] || open[1] || open[2];) {
    context.CheckStop();
    chunks.resize(std::size_t(batch / kChunkPaths));
    context.threads.For(std::int64_t(chunks.size()), [&](std::int64_t c, int worker) {
      TraceChunk(result.paths + c * kChunkPaths, open, targets.radianceFraction,
                 &workers[std::size_t(worker)], &chunks[std::size_t(c)]);
    });
    Merge(chunks, targets, context.threads, &result);
    double least = 1, most = 0;  // least over the requested maps, most over the open maps
    for (std::size_t m = 0; m < kPhotonKindCount; ++m) {
      if (targets.counts[m] == 0) continue;
      PhotonBuffer& buffer = result.buffers[m];
      if (open[m]) buffer.paths = result.paths;
      const auto stored = std::int64_t(buffer.photons.Size());
      const bool isFruitless = stored == 0 && buffer.paths >= kFruitlessPaths;
      open[m] = open[m] && stored < targets.counts[m] && buffer.paths < settings_.maxPhotonPaths &&
                !isFruitless;
      const double filled = Filled(targets, result, m, settings_.maxPhotonPaths);
      least = std::min(least, filled);
      if (open[m]) most = std::max(most, filled);
    }
    batch = NextBatch(batch, result.paths, most);
    context.progress.SetDone(std::int64_t(1000 * least));
  }
  context.progress.End();
  for (const Worker& worker : workers) {
    context.statistics.AddRays(worker.rays);
    for (std::size_t i = 0; i < worker.lights.size(); ++i) result.lights[i].Add(worker.lights[i]);
  }
  return result;
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
