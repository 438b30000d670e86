// SPDX-License-Identifier: BSD-2-Clause
// PhotonTracer traces single photon paths from light to end, and schedules the batches of paths.
#include "integrators/photon/shooting/photon_tracer.h"

#include <algorithm>
#include <limits>
#include <sstream>

#include "core/base/log.h"
#include "core/base/parallel.h"
#include "core/base/progress.h"
#include "core/transport/shading_normal.h"
#include "core/transport/shading_point.h"
#include "integrators/photon/maps/rest_pose.h"
#include "integrators/photon/shooting/photon_chunk.h"
#include "integrators/photon/shooting/photon_path_sampler.h"

namespace exphoton {

// Largest growth of the power of a photon since its emission. A photon beyond it has hit many
// surfaces that reflect more than they receive, and its power could overflow sums over the map.
// Russian roulette never comes near this limit.
constexpr Real kMaxGrowth = Real(std::uint64_t(1) << 40);

// Path follows one photon path to its end, and stores photons for the `open` maps in the chunk.
class PhotonTracer::Path {
 public:
  Path(const PhotonTracer& tracer, const PhotonPathSequences& sequences, std::uint64_t index,
       const std::array<bool, kPhotonKindCount>& open, Real radianceFraction, PhotonChunk* chunk)
      : tracer_(tracer),
        index_(index),
        samples_(sequences, index),
        open_(open),
        radianceFraction_(radianceFraction),
        chunk_(chunk) {}

  void Trace(Arena* arena, RayCounters* rays) {
    RayDifferential ray;
    if (!Emit(&ray)) return;
    if (IsOnlyOpen(PhotonKind::Caustic) && tracer_.specularBoxes_.PassesBy(ray)) {
      ++chunk_->passedBy;
      hasPassedBy_ = true;
      return;
    }
    for (int hits = 1;; ++hits) {
      rays->Count(RayKind::Photon);
      const auto surface = tracer_.scene_.Intersect(ray);
      if (hits == 1 && !isOfMedia_ && tracer_.media_.Scatter()) {
        if (ScatterInMedia(surface ? &surface->p : nullptr, &ray)) {
          hits = 0;  // again a first ray, which now begins in a medium
          continue;
        }
        if (!surface) return;
      } else {
        if (!surface) return;
        Absorb(ray, surface->p);
      }
      hasHit_ = true;
      distance_ += Distance(ray.o, surface->p);
      if (!(alpha_.MaxComponent() > 0)) return;
      const ShadingPoint point =
          MakeShadingPoint(*surface, ray, hits, TransportMode::Importance, arena);
      // Photons from media belong to the indirect map. Gather rays themselves add the light of
      // media between their ends.
      const PhotonKind kind = isOfMedia_        ? PhotonKind::Indirect
                              : hits == 1       ? PhotonKind::Direct
                              : isSpecularPath_ ? PhotonKind::Caustic
                                                : PhotonKind::Indirect;
      if (open_[std::size_t(kind)] && point.bsdf.Has(LobeSet::NonSpecular)) Store(kind, point);
      if (!Scatter(point, hits, &ray)) return;
      arena->Reset();
    }
  }

  void AddTo(std::span<LightTally> lights) const {
    if (light_ < 0) return;  // the path began in a medium
    LightTally& light = lights[std::size_t(light_)];
    ++light.shot;
    light.hit += hasHit_;
    light.passedBy += hasPassedBy_;
    light.stored += stored_;
  }

 private:
  // Multiplies the power by the transmittance of the media up to p.
  void Absorb(const Ray& ray, const Point3& p) {
    if (!tracer_.scene_.HasMedia()) return;
    Ray stretch = ray;
    stretch.tMax = Distance(ray.o, p) / Length(ray.d);
    alpha_ *= tracer_.scene_.Transmittance(stretch);
  }

  // Applies absorption and, if the media scatter, decides whether they scatter the photon. Returns
  // true if the photon continues along a new ray from a point in the media.
  bool ScatterInMedia(const Point3* end, RayDifferential* ray) {
    const Point2 uDistanceChoice = samples_.Next2D(), uDirection = samples_.Next2D();
    Ray stretch = *ray;
    stretch.d = NormalizeOr(ray->d, ray->d);
    const auto passage = tracer_.media_.Pass(stretch, end ? Distance(ray->o, *end) : kInfinity,
                                             alpha_, uDistanceChoice, uDirection);
    alpha_ = passage.alpha;
    if (!passage.scattered) return false;
    *ray = RayDifferential(*passage.scattered);
    isOfMedia_ = true;
    return true;
  }

  // Returns the time of the whole path.
  Real Time() const {
    const auto [open, close] = tracer_.scene_.Exposure();
    if (open == close) return open;
    return std::clamp(Lerp(samples_.Time(), open, close), open, close);
  }

  bool Emit(RayDifferential* ray) {
    const Point2 uLight = samples_.Next2D(), uPosition = samples_.Next2D();
    const Point2 uDirection = samples_.Next2D();
    Real uChoice = uLight.x;
    if (tracer_.mediaShare_ > 0) {
      if (uChoice < tracer_.mediaShare_) {
        const Point3 uPoint(uLight.y, uPosition.x, uPosition.y);
        return EmitFromMedia(uChoice / tracer_.mediaShare_, uPoint, uDirection, ray);
      }
      uChoice = (uChoice - tracer_.mediaShare_) / (1 - tracer_.mediaShare_);
    }
    const auto choice = tracer_.lights_->Sample(std::min(uChoice, kOneMinusEpsilon));
    light_ = choice.index;
    auto emission = choice.light->SampleEmission(uPosition, uDirection, uLight.y, Time());
    if (!emission) return false;
    if (!tracer_.targeting_.IsEmpty() && choice.light->IsDistant())
      tracer_.targeting_.Redirect(&*emission, uPosition);
    *ray = RayDifferential(emission->ray);
    // docs/theory/exphotonmap.md, eq. 3
    return Begin(emission->power / (choice.probability * (1 - tracer_.mediaShare_)));
  }
  bool EmitFromMedia(Real uBox, const Point3& uPoint, Point2 uDirection, RayDifferential* ray) {
    const auto emission =
        tracer_.media_.SampleEmission(std::min(uBox, kOneMinusEpsilon), uPoint, uDirection, Time());
    light_ = -1;
    isOfMedia_ = true;
    *ray = RayDifferential(emission.ray);
    return Begin(emission.power / tracer_.mediaShare_);
  }
  // Sets the emitted power. Returns false if there is nothing to trace.
  bool Begin(const Spectrum& power) {
    alpha_ = power;
    if (!alpha_.IsFinite()) {
      Drop();
      return false;
    }
    maxEmitted_ = alpha_.MaxComponent();
    chunk_->emittedPower += double(alpha_.Y());
    return alpha_.MaxComponent() > 0;
  }

  void Store(PhotonKind kind, const ShadingPoint& point) {
    const SurfaceInteraction& surface = point.surface;
    const RestPose rest(surface);
    const Point3 p = rest.Point(surface.p);
    const Spectrum power = surface.motion ? alpha_ * rest.PowerScale(surface.ng) : alpha_;
    chunk_->photons[std::size_t(kind)].emplace_back(
        Photon{p, rest.Direction(point.Wo()), power, distance_ / tracer_.farthest_});
    ++stored_;
    if (!(radianceFraction_ > 0) || !(samples_.Independent() < radianceFraction_)) return;
    const Spectrum reflectance = point.bsdf.Rho(LobeSet::DiffuseReflection);
    const Spectrum transmittance = point.bsdf.Rho(LobeSet::DiffuseTransmission);
    const bool isGlossy = point.bsdf.Has(LobeSet::Glossy);
    const Real glossy = isGlossy ? point.bsdf.Rho(LobeSet::Glossy).Y() : Real(0);
    const Real diffuse = (reflectance + transmittance).Y();
    chunk_->sites.push_back({p, rest.Normal(FaceForward(surface.ng, point.Wo())), reflectance,
                             transmittance, SafeDivide(glossy, glossy + diffuse, Real(0)),
                             point.bsdf.IsCoated()});
  }

  void Drop() {
    if (chunk_->dropped++ == 0) chunk_->firstDropped = std::int64_t(index_);
  }

  bool IsOnlyOpen(PhotonKind kind) const {
    return open_[std::size_t(kind)] && std::count(open_.begin(), open_.end(), true) == 1;
  }
  // Returns whether an open map can store photons after a bounce of this kind.
  bool IsWantedAfter(bool isSpecular) const {
    if (open_[std::size_t(PhotonKind::Indirect)]) return true;
    return isSpecular && open_[std::size_t(PhotonKind::Caustic)];
  }

  // Samples the BSDF (eq. 5, 6) and plays Russian roulette (eq. 7). Returns false if the path ends.
  bool Scatter(const ShadingPoint& point, int hits, RayDifferential* ray) {
    const Point2 u = samples_.Next2D(), uChoice = samples_.Next2D();
    const auto sample =
        point.bsdf.Sample(point.Wo(), u, uChoice.x, tracer_.lobes_, TransportMode::Importance);
    if (!sample) return false;
    isSpecularPath_ = sample->IsSpecular() && (hits == 1 || isSpecularPath_) && !isOfMedia_;
    if (!sample->IsSpecular()) distance_ = 0;
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
    if (alpha_.MaxComponent() / kMaxGrowth > maxEmitted_) {  // the division cannot overflow
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

  // With Luminance (MaxComponent), the survivor has the luminance (largest channel) from before the
  // bounce, so photon weights stay nearly constant.
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
  PhotonPathSampler samples_;
  const std::array<bool, kPhotonKindCount>& open_;
  Real radianceFraction_;
  PhotonChunk* chunk_;
  int light_ = 0;
  bool hasHit_ = false;
  bool hasPassedBy_ = false;
  bool isOfMedia_ =
      false;  // a medium emitted the photon, or scattered it on its way from the light
  std::int64_t stored_ = 0;  // photon count
  Spectrum alpha_;
  Real maxEmitted_ = 0;
  Real distance_ = 0;            // path length since the light or the last non-specular scattering
  bool isSpecularPath_ = false;  // every bounce so far was specular
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
    Path path(*this, sequences, std::uint64_t(firstPath + i), open, radianceFraction, chunk);
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
