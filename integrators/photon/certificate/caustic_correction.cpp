// SPDX-License-Identifier: BSD-2-Clause
// CausticCorrection: the choice between rays and the kernel, and the points that rays correct.
#include "integrators/photon/certificate/caustic_correction.h"

#include <algorithm>
#include <cmath>

#include "integrators/photon/certificate/caustic_rays.h"
#include "integrators/photon/certificate/separate_context.h"

namespace exphoton {
namespace {

constexpr std::uint64_t kCausticStream = 0x63617573ull;  // "caus" in ASCII
constexpr std::uint64_t kProbeStream = 0x70726f62ull;    // "prob" in ASCII
// Visible points with nothing but caustic light whose caustic is corrected, for each gather ray
// that is corrected.
constexpr double kSeenCaustics = 4;
// The least part of the light that a caustic counts as, because its map may lack it.
constexpr Real kLeastPart = Real(.05);

// The photons whose places probe the rays, and what the rays must find there at least
// (docs/decisions/0104-corrections-of-caustics.md): effective probes (FindsLight), absolutely and
// as a share of the probes, and a share of the light of the map, which blurs a little.
constexpr std::uint64_t kProbes = 4096;
constexpr double kLeastEffective = 8, kLeastEffectiveShare = 1. / 150;
constexpr double kLeastFound = .95;

// Returns the hit where a photon of the map was stored; nullopt: the surface is elsewhere at this
// time.
std::optional<ShadingPoint> PointOf(const PhotonMap& map, std::uint32_t photon, const Scene& scene,
                                    Real time, Arena* arena) {
  constexpr Real kNear = Real(1e-4);  // relative to the scene
  const Real distance = kNear * BoundingSphere(scene.WorldBounds()).radius;
  Ray ray;
  ray.o = map.Position(photon) + map.Direction(photon) * distance;
  ray.d = -map.Direction(photon);
  ray.tMax = 2 * distance;
  ray.time = time;
  const auto hit = scene.Intersect(ray);
  if (!hit) return std::nullopt;
  return MakeShadingPoint(*hit, ray, 0, TransportMode::Radiance, arena);
}

}  // namespace

const PhotonGuide* CausticCorrection::Guide() const {
  std::call_once(isChosen_, [this] {
    if (settings_.CausticPhotons() == 0 || !CausticRaysFindAll(scene_)) return;
    guide_ = PhotonGuide(settings_.gatherPhotons, Cone(Radians(settings_.gatherAngle)));
    guide_.Prepare(maps_.Map(PhotonKind::Caustic));
    if (!FindsLight(guide_)) guide_.Clear();
  });
  return guide_.IsOn() ? &guide_ : nullptr;
}

// A probe is the light that rays find, relative to the light of the map. (sum of x)^2 / (sum of
// x^2) is the number of equal probes x with the same relative noise. If rays rarely meet one of
// several lights, the mean is too low by more than two standard errors.
bool CausticCorrection::FindsLight(const PhotonGuide& guide) const {
  const PhotonMap& map = maps_.Map(PhotonKind::Caustic);
  const std::uint64_t count = std::min<std::uint64_t>(kProbes, map.Size());
  const CameraSamples samples{SampleLayout()};
  Arena arena;
  RayCounters rays;
  double probes = 0, sum = 0, squares = 0;
  for (std::uint64_t i = 0; i < count; ++i) {
    arena.Reset();
    LiContext context{scene_, samples, arena, rays, HashKey({kProbeStream, i})};
    RandomStream random = context.Stream(kProbeStream);
    const auto photon = std::uint32_t(i * map.Size() / count);
    const Interval exposure = scene_.Exposure();
    const Real part = map.HasTimes() ? map.PartOfExposure(photon) : random.Uniform();
    const Real time = exposure.min + part * (exposure.max - exposure.min);
    const auto point = PointOf(map, photon, scene_, time, &arena);
    if (!point) continue;
    const Real mapped = maps_.Radiance(PhotonKind::Caustic, *point, &arena).Y();
    if (!(mapped > 0)) continue;
    CausticRays probe(guide, Cone(Radians(settings_.gatherAngle)), context, &random);
    const double light = double(probe.Sample(*point, LobeSet::NonSpecular).Y() / mapped);
    ++probes, sum += light, squares += light * light;
  }
  const double least = std::max(kLeastEffective, kLeastEffectiveShare * probes);
  // The map is too bright at the place of a photon, which is among the photons of the estimate.
  const double found = kLeastFound * (1 - 1. / settings_.nUsed);
  return squares > 0 && sum * sum >= least * squares &&
         sum + 2 * std::sqrt(squares) >= found * probes;
}

// The chance is in proportion to the share of the caustic in the light, because errors are relative
// to the light.
void CausticCorrection::Correct(const ShadingPoint& point, const SurfaceLight& light,
                                LiContext& context) const {
  CorrectionSample& correction = *context.correction;
  const Real all = (light.direct + light.caustic + light.indirect).Y();
  const Real part = all > 0 ? std::max(light.caustic.Y() / all, kLeastPart) : Real(1);
  const double perGather = correction.share * double(settings_.finalGatherSamples);
  const Real chance = std::min(Real(kSeenCaustics * perGather) * part, Real(1));
  RandomStream random = context.Stream(
      HashKey({SeparateContext::kStream, kCausticStream, std::uint64_t(point.depth)}));
  if (!(random.Uniform() < chance)) return;
  SeparateContext own(context);
  CausticRays rays(*Guide(), Cone(Radians(settings_.gatherAngle)), own.Get(), &random);
  correction.sum +=
      point.throughput * (rays.Sample(point, LobeSet::NonSpecular) - light.caustic) / chance;
}

}  // namespace exphoton
