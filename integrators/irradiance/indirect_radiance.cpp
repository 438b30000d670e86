// SPDX-License-Identifier: BSD-2-Clause
// IndirectRadiance: path tracing without the emission that the first ray hits.
#include "integrators/irradiance/indirect_radiance.h"

#include <algorithm>
#include <bit>

#include "core/math/sampling/mis.h"
#include "core/transport/cut_light.h"
#include "core/transport/light_sample.h"
#include "core/transport/volume_integrator.h"

namespace exphoton {

struct IndirectRadiance::State {
  Ray ray;
  Spectrum beta{1};
  Real etaScale = 1;  // as in "path"
  SurfacePoint from;
  Real bsdfPdf = 0;
  int bounces = 0;
  bool isLastSpecular = false;
};

namespace {

// One context traces many rays.
std::uint64_t KeyOf(const Ray& ray, const LiContext& context) {
  const auto bits = [](Real x) { return std::uint64_t(std::bit_cast<std::uint32_t>(float(x))); };
  return HashKey({context.key, bits(ray.d.x), bits(ray.d.y), bits(ray.d.z)});
}

}  // namespace

IndirectRadiance::IndirectRadiance(const Scene& scene, int maxDepth)
    : maxDepth_(maxDepth),
      hasIndirect_(scene.Features().Needs(Feature::Indirect)),
      hasCaustics_(scene.Features().Needs(Feature::Caustics)),
      lobes_(scene.Features().Needs(Feature::Specular) ? LobeSet::All : LobeSet::NonSpecular),
      lights_(scene.MakeLightSampler(LightSelection::Auto)) {}

IndirectRadiance::Incident IndirectRadiance::Along(const Ray& ray, RandomStream* random,
                                                   LiContext& context) const {
  Incident incident;
  State path;
  path.ray = ray;
  constexpr std::uint64_t kMeasuredPeriod = 32;
  const bool isMeasured = IsCutLightMeasured(KeyOf(ray, context), kMeasuredPeriod);
  for (;; ++path.bounces) {
    const RayKind kind = path.bounces == 0     ? RayKind::Gather
                         : path.isLastSpecular ? RayKind::Specular
                                               : RayKind::Bsdf;
    const auto hit = context.Intersect(path.ray, kind);
    const MediaSegment media = AlongMedia(path.ray, hit ? &hit->p : nullptr, context);
    incident.radiance += path.beta * media.radiance;
    path.beta *= media.transmittance;
    if (path.bounces == 0 && hit) incident.distance = Distance(ray.o, hit->p);
    if (path.bounces > 0 && (path.isLastSpecular ? hasCaustics_ : hasIndirect_))
      incident.radiance += path.beta * Emission(path, hit ? &*hit : nullptr, context.scene);
    if (!hit || path.bounces >= maxDepth_) break;
    const Arena::Mark mark = context.arena.GetMark();
    const ShadingPoint point =
        MakeShadingPoint(*hit, path.ray, path.bounces, TransportMode::Radiance, &context.arena);
    if (hasIndirect_) incident.radiance += path.beta * Direct(point, random, context);
    if (isMeasured && path.bounces + 1 == maxDepth_)
      context.rays.cutGatherLight +=
          double(LightBeyond({point, path.beta, true}, *lights_, context).Y());
    const bool goesOn = Continue(point, random, &path);
    context.arena.Rewind(mark);
    if (!goesOn) break;
  }
  if (isMeasured) context.rays.gatherLight += double(incident.radiance.Y());
  return incident;
}

// Returns the emission at the ray's end, with the MIS weight against the light sample at the vertex
// that the ray left.
Spectrum IndirectRadiance::Emission(const State& path, const SurfaceInteraction* hit,
                                    const Scene& scene) const {
  const Vector3& w = path.ray.d;
  const auto weight = [&](const Light& light) {
    const Real pdf = lights_->Pmf(path.from.p, light) * light.PdfDirect(path.from, w, hit);
    return PowerHeuristic(1, path.bsdfPdf, 1, pdf);
  };
  if (!hit) {
    if (path.isLastSpecular) return scene.EscapedRadiance(w);
    Spectrum sum;
    for (const Light* light : scene.InfiniteLights()) sum += light->Le(w) * weight(*light);
    return sum;
  }
  if (!hit->areaLight) return {};
  const Spectrum radiance = hit->areaLight->L(*hit, hit->uv, hit->wo);
  if (path.isLastSpecular || radiance.IsBlack()) return radiance;
  return radiance * weight(*hit->areaLight);
}

Spectrum IndirectRadiance::Direct(const ShadingPoint& point, RandomStream* random,
                                  LiContext& context) const {
  const Real uChoice = random->Uniform(), x = random->Uniform(), y = random->Uniform();
  const Real uPart = random->Uniform();
  if (lights_->IsEmpty() || !point.bsdf.Has(LobeSet::NonSpecular)) return {};
  const auto choice = lights_->Sample(point.surface.p, uChoice);
  return FromLightSample(point, {choice.light, choice.probability, {x, y}, uPart}, {}, lobes_,
                         context);
}

bool IndirectRadiance::Continue(const ShadingPoint& point, RandomStream* random,
                                State* path) const {
  constexpr int kRouletteDepth = 3;
  constexpr Real kMaxSurvival = Real(.98);
  const Real x = random->Uniform(), y = random->Uniform(), uLobe = random->Uniform();
  const Real uRoulette = random->Uniform();
  const LobeSet lobes = hasIndirect_ ? lobes_ : lobes_ & LobeSet::Specular;
  const auto sample = point.bsdf.Sample(point.Wo(), {x, y}, uLobe, lobes);
  if (!sample) return false;
  if (path->bounces + 1 >= maxDepth_ && sample->IsSpecular()) return false;
  path->beta *= sample->throughput;
  if (sample->IsSpecular() && sample->IsTransmission()) path->etaScale /= sample->eta * sample->eta;
  if (!(path->beta.MaxComponent() > 0) || !path->beta.IsFinite()) return false;
  if (path->bounces >= kRouletteDepth) {
    const Real survival = std::min(path->beta.MaxComponent() * path->etaScale, kMaxSurvival);
    if (!(uRoulette < survival)) return false;
    path->beta /= survival;
  }
  path->ray = SpawnRay(point.surface, sample->wi);
  path->from = point.surface;
  path->bsdfPdf = sample->pdf;
  path->isLastSpecular = sample->IsSpecular();
  return true;
}

}  // namespace exphoton
