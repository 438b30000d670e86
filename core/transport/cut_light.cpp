// SPDX-License-Identifier: BSD-2-Clause
// LightBeyond: path tracing with next event estimation from the last vertex of a path.
#include "core/transport/cut_light.h"

#include <algorithm>
#include <optional>

#include "core/math/sampling/mis.h"
#include "core/transport/light_sample.h"
#include "core/transport/specular/specular_bounce.h"
#include "core/transport/volume_integrator.h"

namespace exphoton {
namespace {

constexpr std::uint64_t kCutStream = 0x6375746cull;
constexpr int kMaxBounces = 64;
constexpr Real kMaxSurvival = Real(.9);

// LongPath is the part of a path beyond the depth limit.
class LongPath {
 public:
  LongPath(const PathEnd& end, const LightSampler& lights, LiContext& context)
      : lights_(lights),
        context_(context),
        random_(context.Stream(kCutStream)),
        beta_(end.beta),
        lobes_(end.lobes),
        isScattered_(end.isScattered) {}

  Spectrum Trace(const ShadingPoint& first) {
    if (!Scatter(first, lobes_)) return {};
    Spectrum sum;
    for (int bounces = 0; bounces < kMaxBounces; ++bounces) {
      const auto hit = context_.Intersect(ray_, isSpecular_ ? RayKind::Specular : RayKind::Bsdf);
      const MediaSegment media = AlongMedia(ray_, hit ? &hit->p : nullptr, context_);
      const bool isKnown = bounces == 0 && !isSpecular_;  // the integrator collects it
      if (!isKnown) {
        sum += beta_ * media.radiance;
        if (TakesEmission()) sum += beta_ * media.transmittance * Emission(hit ? &*hit : nullptr);
      }
      beta_ *= media.transmittance;
      if (!hit) break;
      const Arena::Mark mark = context_.arena.GetMark();
      const ShadingPoint point =
          MakeShadingPoint(*hit, ray_, first.depth + 1, TransportMode::Radiance, &context_.arena);
      if (TakesDirect()) sum += beta_ * Direct(point);
      const bool goesOn = Scatter(point, LobeSet::All);
      context_.arena.Rewind(mark);
      if (!goesOn) break;
    }
    return sum;
  }

 private:
  bool Needs(Feature feature) const { return context_.scene.Features().Needs(feature); }
  bool TakesEmission() const { return !isScattered_ || !isSpecular_ || Needs(Feature::Caustics); }
  bool TakesDirect() const { return !isScattered_ || Needs(Feature::Indirect); }
  LobeSet Lobes() const { return Needs(Feature::Specular) ? LobeSet::All : LobeSet::NonSpecular; }

  bool Scatter(const ShadingPoint& point, LobeSet among) {
    const LobeSet lobes = Lobes() & (TakesDirect() ? among : among & LobeSet::Specular);
    const Point2 u{random_.Uniform(), random_.Uniform()};
    const Real uLobe = random_.Uniform(), uRoulette = random_.Uniform();
    const auto sample = point.bsdf.Sample(point.Wo(), u, uLobe, lobes);
    if (!sample) return false;
    beta_ *= sample->throughput;
    isSpecular_ = sample->IsSpecular();
    if (isSpecular_ && sample->IsTransmission()) etaScale_ /= sample->eta * sample->eta;
    if (!(beta_.MaxComponent() > 0) || !beta_.IsFinite()) return false;
    const Real survival = std::min(beta_.MaxComponent() * etaScale_, kMaxSurvival);
    if (!(uRoulette < survival)) return false;
    beta_ /= survival;
    isScattered_ |= !isSpecular_;
    ray_ = SpawnRay(point.surface, sample->wi);
    if (isSpecular_) AddSpecularDifferentials(point, *sample, &ray_);
    from_ = point.surface;
    receiver_ = point.Receiver();
    bsdfPdf_ = sample->pdf;
    return true;
  }

  // Returns the emission at the ray's end, with the MIS weight against the light sample at the
  // vertex that the ray left.
  Spectrum Emission(const SurfaceInteraction* hit) const {
    const Scene& scene = context_.scene;
    if (!hit) {
      if (isSpecular_) return scene.EscapedRadiance(ray_.d);
      Spectrum sum;
      for (const Light* light : scene.InfiniteLights())
        sum += light->Le(ray_.d) * Weight(*light, nullptr);
      return sum;
    }
    if (!hit->areaLight) return {};
    const Spectrum radiance = hit->areaLight->L(*hit, hit->uv, hit->wo);
    if (isSpecular_ || radiance.IsBlack()) return radiance;
    return radiance * Weight(*hit->areaLight, hit);
  }
  Real Weight(const Light& light, const SurfacePoint* on) const {
    const Real lightPdf = lights_.Pmf(receiver_, light) * light.PdfDirect(from_, ray_.d, on);
    return PowerHeuristic(1, bsdfPdf_, 1, lightPdf);
  }

  Spectrum Direct(const ShadingPoint& point) {
    if (lights_.IsEmpty() || !point.bsdf.Has(LobeSet::NonSpecular)) return {};
    const auto choice = lights_.Sample(point.Receiver(), random_.Uniform());
    const Point2 place{random_.Uniform(), random_.Uniform()};
    return FromLightSample(point, {choice.light, choice.probability, place, random_.Uniform()}, {},
                           Lobes(), context_);
  }

  const LightSampler& lights_;
  LiContext& context_;
  RandomStream random_;
  Spectrum beta_;
  LobeSet lobes_;      // of the first bounce
  Real etaScale_ = 1;  // product of 1/eta^2 at refractions
  bool isScattered_, isSpecular_ = false;
  RayDifferential ray_;
  SurfacePoint from_;       // the last vertex
  LightReceiver receiver_;  // the same
  Real bsdfPdf_ = 0;        // of the ray's direction, per solid angle
};

}  // namespace

Spectrum LightBeyond(const PathEnd& end, const LightSampler& lights, LiContext& context) {
  const std::uint64_t mediaSegments = context.mediaSegments;
  const auto counts = context.rays.counts;
  const Spectrum light = LongPath(end, lights, context).Trace(end.point);
  context.mediaSegments = mediaSegments;
  context.rays.counts = counts;
  return light.IsFinite() ? light : Spectrum();
}

}  // namespace exphoton
