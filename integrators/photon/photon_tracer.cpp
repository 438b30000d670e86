// SPDX-License-Identifier: BSD-2-Clause
// Shooting photons: one path from its light to its end, and the batches that paths come in.
#include "integrators/photon/photon_tracer.h"

#include <algorithm>
#include <sstream>

#include "core/base/log.h"
#include "core/base/parallel.h"
#include "core/base/progress.h"
#include "core/transport/shading_normal.h"
#include "core/transport/shading_point.h"
#include "integrators/photon/path_samples.h"
#include "integrators/photon/rest_pose.h"

namespace exphoton {

// A photon that has grown by so much since its light has met surfaces that reflect more than they
// receive, over and over; sums over maps with such photons would overflow. No roulette comes near.
constexpr Real kMostGrowth = Real(std::uint64_t(1) << 40);

namespace {

struct PathTally {
  int light = 0;
  bool hasHit = false;
  std::int64_t stored = 0;
};

}  // namespace

// A map that holds this part of its target gets memory for the whole.
constexpr std::int64_t kShareBeforeReserving = 16;

// What one piece of work leaves behind.
struct PhotonTracer::Chunk {
  std::array<std::vector<PhotonRecord>, kPhotonKindCount> photons;
  std::array<std::vector<RadianceSeed>, kPhotonKindCount> seeds;  // by the map of their photon
  double emittedPower = 0, cutPower = 0;
  std::int64_t dropped = 0, firstDropped = -1;  // photons; the number of the first one's path
  std::int64_t overgrown = 0;
  std::array<PathTally, kChunkPaths> paths;
};

// One photon path: follows it to its end and stores into the chunk what `open` maps want.
class PhotonTracer::Path {
 public:
  Path(const PhotonTracer& tracer, std::uint64_t index,
       const std::array<bool, kPhotonKindCount>& open, Real radianceFraction, Chunk* chunk)
      : tracer_(tracer),
        index_(index),
        samples_(tracer.seed_, index),
        open_(open),
        radianceFraction_(radianceFraction),
        chunk_(chunk) {}

  void Trace(Arena* arena, RayCounters* rays) {
    RayDifferential ray;
    if (!Emit(&ray)) return;
    for (int hits = 1;; ++hits) {
      rays->Count(RayKind::Photon);
      const auto surface = tracer_.scene_.Intersect(ray);
      if (!surface) return;
      tally_.hasHit = true;
      Absorb(ray, surface->p);
      if (!(alpha_.MaxComponent() > 0)) return;
      const ShadingPoint point =
          MakeShadingPoint(*surface, ray, hits, TransportMode::Importance, arena);
      const PhotonKind kind = hits == 1         ? PhotonKind::Direct
                              : isSpecularPath_ ? PhotonKind::Caustic
                                                : PhotonKind::Indirect;
      if (open_[std::size_t(kind)] && point.bsdf.Has(LobeSet::NonSpecular)) Store(kind, point);
      if (!Scatter(point, hits, &ray)) return;
      arena->Reset();
    }
  }

  const PathTally& Tally() const { return tally_; }

 private:
  // What media take from the photon on its way to p.
  void Absorb(const Ray& ray, const Point3& p) {
    if (!tracer_.scene_.HasMedia()) return;
    Ray stretch = ray;
    stretch.tMax = Distance(ray.o, p) / Length(ray.d);
    alpha_ *= tracer_.scene_.Transmittance(stretch);
  }

  // Of all of the path.
  Real Time() const {
    const auto [open, close] = tracer_.scene_.Exposure();
    if (open == close) return open;
    return std::clamp(Lerp(samples_.Time(), open, close), open, close);
  }

  bool Emit(RayDifferential* ray) {
    const Point2 uLight = samples_.Next2D(), uPosition = samples_.Next2D();
    const Point2 uDirection = samples_.Next2D();
    const auto choice = tracer_.lights_.Sample(uLight.x);
    tally_.light = choice.index;
    auto emission = choice.light->SampleEmission(uPosition, uDirection, uLight.y, Time());
    if (!emission) return false;
    if (!tracer_.aim_.IsEmpty() && choice.light->IsFar())
      tracer_.aim_.Redirect(&*emission, uPosition);
    alpha_ = emission->power / choice.probability;  // docs/exphotonmap.md, eq. 3
    if (!alpha_.IsFinite()) {
      Drop();
      return false;
    }
    emittedMost_ = alpha_.MaxComponent();
    chunk_->emittedPower += double(alpha_.Y());
    *ray = RayDifferential(emission->ray);
    return alpha_.MaxComponent() > 0;
  }

  void Store(PhotonKind kind, const ShadingPoint& point) {
    const SurfaceInteraction& surface = point.surface;
    const RestPose rest(surface);
    const Point3 p = rest.Point(surface.p);
    const Spectrum power = surface.motion ? alpha_ * rest.PowerScale(surface.ng) : alpha_;
    chunk_->photons[std::size_t(kind)].emplace_back(Photon{p, rest.Direction(point.Wo()), power});
    ++tally_.stored;
    if (!(radianceFraction_ > 0) || !(samples_.Independent() < radianceFraction_)) return;
    chunk_->seeds[std::size_t(kind)].push_back({p, rest.Normal(FaceForward(surface.ng, point.Wo())),
                                                point.bsdf.Rho(LobeSet::NonSpecularReflection),
                                                point.bsdf.Rho(LobeSet::NonSpecularTransmission)});
  }

  void Drop() {
    if (chunk_->dropped++ == 0) chunk_->firstDropped = std::int64_t(index_);
  }

  // Whether a map still wants photons of what comes after a bounce of this kind.
  bool IsWantedAfter(bool isSpecular) const {
    if (open_[std::size_t(PhotonKind::Indirect)]) return true;
    return isSpecular && open_[std::size_t(PhotonKind::Caustic)];
  }

  // Bsdf sampling (eq. 5 and 6) and Russian roulette (eq. 7); false where the path ends.
  bool Scatter(const ShadingPoint& point, int hits, RayDifferential* ray) {
    const Point2 u = samples_.Next2D(), uChoice = samples_.Next2D();
    const auto sample =
        point.bsdf.Sample(point.Wo(), u, uChoice.x, tracer_.lobes_, TransportMode::Importance);
    if (!sample) return false;
    isSpecularPath_ = sample->IsSpecular() && (hits == 1 || isSpecularPath_);
    if (!IsWantedAfter(isSpecularPath_)) return false;
    const Spectrum scattered =
        alpha_ * sample->throughput *
        ShadingNormalFactor(point.Wo(), sample->wi, point.bsdf.Ng(), point.bsdf.Ns());
    const Real survival = SurvivalProbability(scattered, hits);
    if (!(uChoice.y < survival)) return false;
    alpha_ = scattered / survival;
    if (!alpha_.IsFinite()) {
      Drop();
      return false;
    }
    if (alpha_.MaxComponent() / kMostGrowth > emittedMost_) {  // cannot overflow
      ++chunk_->overgrown;
      return false;
    }
    if (hits >= tracer_.settings_.maxPhotonDepth) {
      chunk_->cutPower += double(alpha_.Y());
      return false;
    }
    *ray = SpawnRay(point.surface, sample->wi);
    return true;
  }

  // exphotonmap: the survivor keeps what the photon had, so weights stay nearly constant.
  Real SurvivalProbability(const Spectrum& scattered, int hits) const {
    constexpr int kPlainBounces = 3;
    switch (tracer_.settings_.photonRoulette) {
      case PhotonRoulette::Half:
        return hits > kPlainBounces ? Real(.5) : Real(1);
      case PhotonRoulette::MaxComponent:
        return std::min(Real(1),
                        SafeDivide(scattered.MaxComponent(), alpha_.MaxComponent(), Real(0)));
      case PhotonRoulette::Luminance:
        break;
    }
    return std::min(Real(1), SafeDivide(scattered.Y(), alpha_.Y(), Real(0)));
  }

  const PhotonTracer& tracer_;
  std::uint64_t index_;
  PathSamples samples_;
  const std::array<bool, kPhotonKindCount>& open_;
  Real radianceFraction_;
  Chunk* chunk_;
  PathTally tally_;
  Spectrum alpha_;
  Real emittedMost_ = 0;
  bool isSpecularPath_ = false;  // every bounce so far was specular
};

namespace {

// An aimed light needs fewer photons by as much as they lie denser.
std::vector<double> ShareFactors(const Scene& scene, const PhotonAim& aim) {
  std::vector<double> factors(scene.Lights().size(), 1.0);
  if (aim.IsEmpty()) return factors;
  for (std::size_t i = 0; i < factors.size(); ++i)
    if (scene.Lights()[i]->IsFar()) factors[i] = 1 / std::max(aim.Gain(), 1.0);
  return factors;
}

}  // namespace

PhotonTracer::PhotonTracer(const Scene& scene, const PhotonSettings& settings, std::uint64_t seed,
                           PhotonAim aim)
    : scene_(scene),
      settings_(settings),
      seed_(seed),
      aim_(std::move(aim)),
      lights_(scene.Lights(), settings.lightSelection, LightDistribution::kUniformShare,
              ShareFactors(scene, aim_)),
      lobes_(scene.Effects().Needs(Effect::Specular) ? LobeSet::All : LobeSet::NonSpecular) {}

PhotonTracer::Chunk PhotonTracer::TraceChunk(std::int64_t firstPath,
                                             const std::array<bool, kPhotonKindCount>& open,
                                             Real radianceFraction, Arena* arena,
                                             RayCounters* rays) const {
  Chunk chunk;
  for (int i = 0; i < kChunkPaths; ++i) {
    Path path(*this, std::uint64_t(firstPath + i), open, radianceFraction, &chunk);
    arena->Reset();
    path.Trace(arena, rays);
    chunk.paths[std::size_t(i)] = path.Tally();
  }
  return chunk;
}

namespace {

// Progress of the map that is farthest from its target.
std::int64_t Promille(const PhotonTargets& targets, const PhotonHarvest& harvest,
                      std::int64_t maxPaths) {
  double least = 1;
  for (std::size_t m = 0; m < kPhotonKindCount; ++m) {
    if (targets.counts[m] == 0) continue;
    const double filled = double(harvest.hauls[m].photons.Size()) / double(targets.counts[m]);
    const double spent = double(harvest.hauls[m].paths) / double(maxPaths);
    least = std::min(least, std::max(filled, spent));
  }
  return std::int64_t(1000 * least);
}

}  // namespace

PhotonHarvest PhotonTracer::Shoot(const PhotonTargets& targets, PreprocessContext& context) const {
  PhotonHarvest harvest;
  std::array<bool, kPhotonKindCount> open{};
  for (std::size_t m = 0; m < kPhotonKindCount; ++m) open[m] = targets.counts[m] > 0;
  harvest.lights.resize(scene_.Lights().size());
  if (lights_.IsEmpty()) return harvest;

  const auto workers = std::size_t(context.threads.Count());
  std::vector<Arena> arenas(workers);
  std::vector<RayCounters> rays(workers);
  context.progress.Begin("Shooting photons", 1000);
  for (std::int64_t batch = kChunkPaths; open[0] || open[1] || open[2];
       batch = std::min(2 * batch, kMaxBatchPaths)) {
    std::vector<Chunk> chunks(std::size_t(batch / kChunkPaths));
    context.threads.For(std::int64_t(chunks.size()), [&](std::int64_t c, int worker) {
      chunks[std::size_t(c)] =
          TraceChunk(harvest.paths + c * kChunkPaths, open, targets.radianceFraction,
                     &arenas[std::size_t(worker)], &rays[std::size_t(worker)]);
    });
    harvest.paths += batch;
    for (Chunk& chunk : chunks) {
      for (std::size_t m = 0; m < kPhotonKindCount; ++m) {
        BlockStore<PhotonBlock>& photons = harvest.hauls[m].photons;
        photons.Append(chunk.photons[m]);
        // From here on it will hardly stay empty: memory for all, once, and for the last batch.
        if (std::int64_t(photons.Size()) >= targets.counts[m] / kShareBeforeReserving)
          photons.Reserve(std::size_t(targets.counts[m] + targets.counts[m] / 64));
        harvest.seeds.insert(harvest.seeds.end(), chunk.seeds[m].begin(), chunk.seeds[m].end());
      }
      for (const PathTally& path : chunk.paths) {
        LightTally& light = harvest.lights[std::size_t(path.light)];
        ++light.shot;
        light.hit += path.hasHit;
        light.stored += path.stored;
      }
      harvest.emittedPower += chunk.emittedPower;
      harvest.cutPower += chunk.cutPower;
      if (harvest.droppedPhotons == 0) harvest.firstDroppedPath = chunk.firstDropped;
      harvest.droppedPhotons += chunk.dropped;
      harvest.overgrownPaths += chunk.overgrown;
    }
    for (std::size_t m = 0; m < kPhotonKindCount; ++m) {
      if (!open[m]) continue;
      PhotonHaul& haul = harvest.hauls[m];
      haul.paths = harvest.paths;
      const auto stored = std::int64_t(haul.photons.Size());
      const bool isFruitless = stored == 0 && haul.paths >= kFruitlessPaths;
      open[m] = stored < targets.counts[m] && haul.paths < settings_.maxPhotonPaths && !isFruitless;
    }
    context.progress.SetDone(Promille(targets, harvest, settings_.maxPhotonPaths));
  }
  context.progress.End();
  for (const RayCounters& counters : rays) context.statistics.AddRays(counters);
  return harvest;
}

}  // namespace exphoton
