// SPDX-License-Identifier: BSD-2-Clause
// PhotonTracer::Path: emission, scattering, Russian roulette or rejection, and storing.
#include "integrators/photon/shooting/photon_path.h"

#include <algorithm>

#include "core/transport/shading_normal.h"
#include "integrators/photon/maps/rest_pose.h"
#include "integrators/photon/shooting/radiance_site.h"

namespace exphoton {
namespace {

// Largest growth of the power of a photon since its emission. A photon beyond it has hit many
// surfaces that reflect more than they receive, and its power could overflow sums over the map.
// Russian roulette never comes near this limit.
constexpr Real kMaxGrowth = Real(std::uint64_t(1) << 40);
// With "half", photons survive this number of bounces.
constexpr int kPlainBounces = 3;
// Most branches of a path with photonroulette "constant". Only surfaces that reflect more than they
// receive come near it.
constexpr int kMaxBranches = 1 << 14;

}  // namespace

EmissionNumbers PhotonTracer::Path::DrawEmissionNumbers() {
  const Point2 light = samples_.Next2D(), position = samples_.Next2D();
  const Point2 direction = samples_.Next2D();
  const auto [from, to] = tracer_.exposure_;
  const Real time = from == to ? Real(0) : samples_.Time();
  return {light.x, {position.x, position.y, direction.x, direction.y, light.y, time}};
}

void PhotonTracer::Path::Trace(Arena* arena, RayCounters* rays) {
  EmissionNumbers u = DrawEmissionNumbers();
  const Source source = ChooseSource(&u);
  if (!tracer_.rejection_.IsInUse()) {
    if (IsOutOfReach(source)) {
      if (batch_.isRecorded) Record(source, u);
      return;
    }
    const auto power = Emit(source, u);
    if (power && Begin(*power)) Follow(arena, rays);
    if (batch_.isRecorded) Record(source, u);
    return;
  }
  branches_->clear();
  EmitCopies(source, u);
  while (!branches_->empty() && !HasTooManyBranches()) {
    now_ = branches_->back();
    branches_->pop_back();
    Follow(arena, rays);
    arena->Reset();
  }
}

void PhotonTracer::Path::Record(const Source& source, const EmissionNumbers& u) const {
  if (!source.light) return;
  EmissionSample sample;
  std::copy(u.u.begin(), u.u.end(), sample.u.begin());
  sample.light = light_;
  sample.inverseDensity = float(1 / source.probability);
  for (std::size_t m = 0; m < kPhotonKindCount; ++m)
    sample.kept[m] = hasStored_[m] ? float(emitted_ * double(source.probability)) : 0.F;
  chunk_->samples.push_back(sample);
}

void PhotonTracer::Path::Follow(Arena* arena, RayCounters* rays) {
  if (IsSkipped()) return;
  for (;; ++now_.hits) {
    rays->Count(RayKind::Photon);
    const auto surface = tracer_.scene_.Intersect(now_.ray);
    if (now_.hits == 1 && !now_.isOfMedia && tracer_.media_.Scatter()) {
      if (ScatterInMedia(surface ? &surface->p : nullptr)) {
        now_.hits = 0;  // again a first ray, which now begins in a medium
        continue;
      }
      if (!surface) return;
    } else {
      if (!surface || !Absorb(surface->p)) return;
    }
    hasHit_ = true;
    now_.distance += Distance(now_.ray.o, surface->p);
    if (!(now_.alpha.MaxComponent() > 0)) return;
    const ShadingPoint point =
        MakeShadingPoint(*surface, now_.ray, now_.hits, TransportMode::Importance, arena);
    // Photons from media belong to the indirect map. Gather rays themselves add the light of
    // media between their ends.
    const PhotonKind kind = now_.isOfMedia        ? PhotonKind::Indirect
                            : now_.hits == 1      ? PhotonKind::Direct
                            : now_.isSpecularPath ? PhotonKind::Caustic
                                                  : PhotonKind::Indirect;
    if (batch_.open[std::size_t(kind)] && point.bsdf.Has(LobeSet::NonSpecular)) Store(kind, point);
    if (!Scatter(point)) return;
    arena->Reset();
  }
}

bool PhotonTracer::Path::IsSkipped() {
  if (now_.hits != 1) return false;
  if (IsOnlyOpen(PhotonKind::Caustic) && tracer_.specularBoxes_.Misses(now_.ray)) {
    chunk_->skipped += !isSkipped_;
    isSkipped_ = true;
    return true;
  }
  return false;
}

// The power that would have been emitted counts. Lights with a proof emit the same along all rays.
bool PhotonTracer::Path::IsOutOfReach(const Source& source) {
  if (!source.light || !IsOnlyOpen(PhotonKind::Caustic)) return false;
  if (!tracer_.causticLights_.IsOutOfReach(light_)) return false;
  if (!batch_.guide)
    chunk_->emittedPower += double((source.light->Power() / source.probability).Y());
  chunk_->skipped += 1;
  isSkipped_ = true;
  return true;
}

void PhotonTracer::Path::AddTo(std::span<LightTally> lights) const {
  if (light_ < 0) return;
  LightTally& light = lights[std::size_t(light_)];
  ++light.shot;
  light.hit += hasHit_;
  light.skipped += isSkipped_;
  if (batch_.isDiscarded) return;
  light.stored += stored_;
  light.caustic += caustic_;
}

// Multiplies the power by the transmittance of the media up to p. Returns false if the photon ends.
bool PhotonTracer::Path::Absorb(const Point3& p) {
  if (!tracer_.scene_.HasMedia()) return true;
  Ray stretch = now_.ray;
  stretch.tMax = Distance(now_.ray.o, p) / Length(now_.ray.d);
  now_.alpha *= tracer_.scene_.Transmittance(stretch);
  if (!tracer_.rejection_.IsInUse()) return true;
  const auto accepted = Accept(now_.alpha, 1, samples_.Independent());
  if (accepted) now_.alpha = *accepted;
  return accepted.has_value();
}

// Applies absorption and, if the media scatter, decides whether they scatter the photon. Returns
// true if the photon continues along a new ray from a point in the media.
bool PhotonTracer::Path::ScatterInMedia(const Point3* end) {
  const Point2 uDistanceChoice = samples_.Next2D(), uDirection = samples_.Next2D();
  Ray stretch = now_.ray;
  stretch.d = NormalizeOr(now_.ray.d, now_.ray.d);
  const auto passage = tracer_.media_.Pass(stretch, end ? Distance(now_.ray.o, *end) : kInfinity,
                                           now_.alpha, uDistanceChoice, uDirection);
  now_.alpha = passage.alpha;
  if (tracer_.rejection_.IsInUse())
    now_.alpha = Accept(now_.alpha, 1, samples_.Independent()).value_or(Spectrum());
  if (!passage.scattered) return false;
  now_.ray = RayDifferential(*passage.scattered);
  now_.isOfMedia = true;
  return true;
}

// Returns the time of the whole path.
Real PhotonTracer::Path::Time(Real u) const {
  const auto [from, to] = tracer_.exposure_;
  if (from == to) return from;
  return std::clamp(Lerp(u, from, to), from, to);
}

PhotonTracer::Path::Source PhotonTracer::Path::ChooseSource(EmissionNumbers* u) {
  if (batch_.guide) {
    const auto choice = batch_.guide->Warp(u);
    light_ = choice.light;
    return {tracer_.scene_.Lights()[std::size_t(light_)].get(), Real(choice.density), 0};
  }
  Real uChoice = u->light;
  if (tracer_.mediaShare_ > 0) {
    if (uChoice < tracer_.mediaShare_) {
      light_ = -1;
      const Real uBox = std::min(uChoice / tracer_.mediaShare_, kOneMinusEpsilon);
      return {nullptr, tracer_.mediaShare_, uBox};
    }
    uChoice = (uChoice - tracer_.mediaShare_) / (1 - tracer_.mediaShare_);
  }
  const auto choice = tracer_.lights_->Sample(std::min(uChoice, kOneMinusEpsilon));
  light_ = choice.index;
  return {choice.light, choice.probability * (1 - tracer_.mediaShare_), 0};
}

std::optional<Spectrum> PhotonTracer::Path::Emit(const Source& source, const EmissionNumbers& u) {
  now_ = {};
  if (!source.light) {
    const Point3 uPoint(u.SubLight(), u.Position().x, u.Position().y);
    const auto emission =
        tracer_.media_.SampleEmission(source.uBox, uPoint, u.Direction(), Time(u.Time()));
    now_.isOfMedia = true;
    now_.ray = RayDifferential(emission.ray);
    return emission.power / source.probability;
  }
  auto emission =
      source.light->SampleEmission(u.Position(), u.Direction(), u.SubLight(), Time(u.Time()));
  if (!emission) return std::nullopt;
  if (!tracer_.targeting_.IsEmpty() && source.light->IsDistant())
    tracer_.targeting_.Redirect(&*emission, u.Position());
  now_.ray = RayDifferential(emission->ray);
  const Spectrum power = emission->power / source.probability;  // docs/theory/exphotonmap.md, eq. 3
  return power * tracer_.scene_.TransmittanceBefore(*source.light, now_.ray);
}

bool PhotonTracer::Path::Begin(const Spectrum& power) {
  now_.alpha = power;
  if (!now_.alpha.IsFinite()) {
    Drop();
    return false;
  }
  maxEmitted_ = now_.alpha.MaxComponent();
  emitted_ = double(now_.alpha.Y());
  if (!batch_.guide) chunk_->emittedPower += emitted_;
  return now_.alpha.MaxComponent() > 0;
}

void PhotonTracer::Path::EmitCopies(const Source& source, EmissionNumbers u) {
  const int copies = source.light ? tracer_.rejection_.CopiesOfLight(light_) : 1;
  for (int i = 0; i < copies; ++i) {
    if (i > 0) {
      const Real subLight = samples_.Independent();
      const Point2 position = samples_.IndependentPair(), direction = samples_.IndependentPair();
      u.u = {position.x, position.y, direction.x, direction.y, subLight, u.Time()};
    }
    const auto power = Emit(source, u);
    if (!power) continue;
    if (!power->IsFinite()) {
      Drop();
      continue;
    }
    chunk_->emittedPower += double(power->Y()) / copies;
    const auto accepted = Accept(*power, copies, samples_.Independent());
    if (!accepted) continue;
    now_.alpha = *accepted;
    branches_->push_back(now_);
  }
}

void PhotonTracer::Path::Store(PhotonKind kind, const ShadingPoint& point) {
  const SurfaceInteraction& surface = point.surface;
  const RestPose rest(surface);
  const Point3 p = rest.Point(surface.p);
  const Real onSmooth = CosineRatio(point.Wo(), point.smooth, surface.ng);
  const Spectrum power = now_.alpha * (onSmooth * rest.PowerScale(surface.ng));
  const Photon photon{p, rest.Direction(point.Wo()), power, now_.distance / tracer_.farthest_,
                      HasNegativeSign()};
  chunk_->photons[std::size_t(kind)].emplace_back(photon,
                                                  tracer_.PayloadOf(kind, photon, now_.ray.time));
  ++stored_;
  caustic_ += kind == PhotonKind::Caustic;
  hasStored_[std::size_t(kind)] = true;
  const Real fraction = batch_.radianceFraction;
  if (!(fraction > 0) || !(samples_.Independent() < fraction)) return;
  chunk_->sites.push_back(RadianceSiteAt(point, rest));
}

void PhotonTracer::Path::Drop() {
  if (chunk_->dropped++ == 0) chunk_->firstDropped = std::int64_t(index_);
}

bool PhotonTracer::Path::IsOnlyOpen(PhotonKind kind) const {
  return batch_.open[std::size_t(kind)] &&
         std::count(batch_.open.begin(), batch_.open.end(), true) == 1;
}

// Returns whether an open map can store photons after a bounce of this kind.
bool PhotonTracer::Path::IsWantedAfter(bool isSpecular) const {
  if (batch_.open[std::size_t(PhotonKind::Indirect)]) return true;
  return isSpecular && batch_.open[std::size_t(PhotonKind::Caustic)];
}

// Samples the BSDF (eq. 5, 6). Returns the scattered power, before Russian roulette or rejection,
// and sets everything else of `next`; nullopt if the photon is absorbed or of no use.
std::optional<Spectrum> PhotonTracer::Path::SampleBsdf(const ShadingPoint& point, Real uLobe,
                                                       Point2 u, PhotonBranch* next) const {
  const auto sample =
      point.bsdf.Sample(point.Wo(), u, uLobe, tracer_.lobes_, TransportMode::Importance);
  if (!sample) return std::nullopt;
  const bool isSpecularPath = now_.hits == 1 || now_.isSpecularPath;
  next->isSpecularPath = sample->IsSpecular() && isSpecularPath && !now_.isOfMedia;
  next->isOfMedia = now_.isOfMedia;
  next->distance = sample->IsSpecular() ? now_.distance : 0;
  if (!IsWantedAfter(next->isSpecularPath)) return std::nullopt;
  next->ray = SpawnRay(point.surface, sample->wi);
  return now_.alpha * sample->throughput *
         ShadingNormalFactor(point.Wo(), sample->wi, point.bsdf.Ng(), point.bsdf.Ns());
}

// Samples the BSDF and plays Russian roulette (eq. 7). Returns false if the path ends or branches.
bool PhotonTracer::Path::Scatter(const ShadingPoint& point) {
  if (tracer_.rejection_.IsInUse()) {
    ScatterCopies(point);
    return false;
  }
  const Point2 u = samples_.Next2D(), uChoice = samples_.Next2D();
  PhotonBranch next;
  const auto scattered = SampleBsdf(point, uChoice.x, u, &next);
  if (!scattered) return false;
  const Real survival = SurvivalProbability(*scattered);
  if (IsHalved() && now_.hits > kPlainBounces) {
    const double growth = double(SafeDivide(scattered->Y(), now_.alpha.Y(), Real(0)));
    chunk_->squaredGrowth += growth * growth / double(survival);
  }
  if (!(uChoice.y < survival)) return false;
  next.alpha = *scattered / survival;
  next.hits = now_.hits;
  if (IsCut(next.alpha)) return false;
  chunk_->halvedRays += IsHalved() && now_.hits >= kPlainBounces;
  now_ = next;
  return true;
}

// Returns whether a photon of this power ends, for another reason than chance.
bool PhotonTracer::Path::IsCut(const Spectrum& power) {
  if (!power.IsFinite()) {
    Drop();
    return true;
  }
  // The division cannot overflow. Rejection bounds the power of a photon, but not their number.
  if (!tracer_.rejection_.IsInUse() && power.MaxComponent() / kMaxGrowth > maxEmitted_) {
    ++chunk_->diverging;
    return true;
  }
  if (now_.hits >= tracer_.settings_.maxPhotonDepth) {
    if (!batch_.guide) chunk_->cutPower += double(power.Y());
    return true;
  }
  return false;
}

// With "constant", draws as many candidates as their bound requires. Each accepted one becomes a
// branch.
void PhotonTracer::Path::ScatterCopies(const ShadingPoint& point) {
  // The correction for shading normals is |wo.ns / wo.ng| |wi.ng / wi.ns|. The second factor is
  // below 2 except near the horizon of the shading normal.
  constexpr Real kLikelyRatio = 2;
  Real largest = now_.alpha.Y();
  if (const auto bound = point.bsdf.ThroughputBound(point.Wo(), tracer_.lobes_)) {
    largest = (now_.alpha * *bound).Y();
    const Real cosine = AbsDot(point.Wo(), point.bsdf.Ng());
    if (!(point.bsdf.Ng() == point.bsdf.Ns()) && cosine > 0)
      largest *= kLikelyRatio * AbsDot(point.Wo(), point.bsdf.Ns()) / cosine;
  }
  const int copies = tracer_.rejection_.Copies(largest);
  for (int i = 0; i < copies; ++i) {
    const Point2 u = samples_.Next2D(), uChoice = samples_.Next2D();
    PhotonBranch next;
    const auto scattered = SampleBsdf(point, uChoice.x, u, &next);
    const auto accepted = Accept(scattered.value_or(Spectrum()), copies, uChoice.y);
    if (!accepted || IsCut(*accepted)) continue;
    next.alpha = *accepted;
    next.hits = now_.hits + 1;
    branches_->push_back(next);
    ++branchCount_;
  }
}

std::optional<Spectrum> PhotonTracer::Path::Accept(const Spectrum& power, int copies, Real u) {
  ++chunk_->candidates;
  const auto accepted = tracer_.rejection_.Accept(power, copies, u);
  if (!accepted) return std::nullopt;
  chunk_->beyondBound += accepted->isBeyondBound;
  return accepted->power;
}

bool PhotonTracer::Path::HasTooManyBranches() {
  if (branchCount_ <= kMaxBranches) return false;
  ++chunk_->diverging;
  return true;
}

// Returns whether the squared power is counted. Paths end at diffuse surfaces if they are for
// caustics only.
bool PhotonTracer::Path::IsHalved() const {
  return tracer_.settings_.photonRoulette == PhotonRoulette::Half &&
         batch_.open[std::size_t(PhotonKind::Indirect)];
}

// With Luminance (MaxComponent), the survivor has the luminance (largest channel) from before the
// bounce, so photon weights stay nearly constant.
Real PhotonTracer::Path::SurvivalProbability(const Spectrum& scattered) const {
  const Spectrum& alpha = now_.alpha;
  switch (tracer_.settings_.photonRoulette) {
    case PhotonRoulette::Half:
      return now_.hits > kPlainBounces ? Real(.5) : Real(1);
    case PhotonRoulette::MaxComponent:
      return std::min(Real(1), SafeDivide(scattered.MaxComponent(), alpha.MaxComponent(), Real(0)));
    case PhotonRoulette::Luminance:
    case PhotonRoulette::Constant:
      break;
  }
  return std::min(Real(1), SafeDivide(scattered.Y(), alpha.Y(), Real(0)));
}

}  // namespace exphoton
