// SPDX-License-Identifier: BSD-2-Clause
// PhotonLighting decides which photons to trace, builds the maps, and evaluates the terms of the
// radiance equation that read them.
#include "integrators/photon/photon_lighting.h"

#include <algorithm>
#include <cmath>
#include <new>

#include "core/base/error.h"
#include "core/base/memory.h"
#include "integrators/photon/gather/gather_ray.h"
#include "integrators/photon/maps/rest_pose.h"
#include "integrators/photon/photon_stats.h"
#include "integrators/photon/shooting/visible_points.h"

namespace exphoton {

namespace {

bool HasReceiver(const Scene& scene) {
  const auto& materials = scene.Materials();
  return std::any_of(materials.begin(), materials.end(), [](const auto& material) {
    return Intersects(material->PossibleLobes(), LobeSet::NonSpecular);
  });
}

// Formats targets as "100 direct, 200 indirect"; returns an empty string if there are none.
std::string TextOf(const PhotonTargets& targets) {
  std::string text;
  for (const PhotonKind kind : {PhotonKind::Direct, PhotonKind::Caustic, PhotonKind::Indirect}) {
    if (targets[kind] == 0) continue;
    text += (text.empty() ? "" : ", ") + std::to_string(targets[kind]) + " " + PhotonKindName(kind);
  }
  return text;
}

// Returns the memory of the maps when all targets are reached.
double BytesOf(const PhotonTargets& targets) {
  double photons = 0;
  for (const auto count : targets.counts) photons += double(count);
  return photons * (double(PhotonMap::kBytesPerPhoton) +
                    double(targets.radianceFraction) * double(RadiancePhotonMap::kBytesPerEntry));
}

[[noreturn]] void FailByMemory(const PhotonTargets& targets) {
  throw Error(ExitStatus::Resource, "photon maps of " + TextOf(targets) + " photons take " +
                                        Megabytes(BytesOf(targets)) +
                                        ", and more while they are built; " + MemoryLimit());
}

}  // namespace

bool PhotonLighting::Gathers(const Scene& scene) const {
  return settings_.finalGather && settings_.show == ShowMap::Nothing &&
         scene.Features().Needs(Feature::Indirect);
}

// A map is requested if something will read it and this scene can fill it.
PhotonTargets PhotonLighting::Targets(const Scene& scene) const {
  const ShowMap show = settings_.show;
  const bool showsAll = show == ShowMap::Nothing || show == ShowMap::Radiance;
  const bool gathers = Gathers(scene), showsRadiance = show == ShowMap::Radiance;
  const bool hasIndirect = scene.Features().Needs(Feature::Indirect);
  const bool hasLight = scene.ShiningLights() > 0;  // media fill only the indirect map
  PhotonTargets targets;
  const bool hasCaustics = hasLight && scene.Features().Needs(Feature::Caustics) &&
                           scene.Features().Needs(Feature::Specular);
  if (hasCaustics && (showsAll || show == ShowMap::Caustic))
    targets[PhotonKind::Caustic] = settings_.CausticPhotons();
  if (hasIndirect && (showsAll || show == ShowMap::Indirect))
    targets[PhotonKind::Indirect] = settings_.indirectPhotons;
  if (hasLight &&
      ((hasIndirect && (gathers || showsRadiance)) ||
       (HasReceiver(scene) && ((needsDirectMap_ && showsAll) || show == ShowMap::Direct))))
    targets[PhotonKind::Direct] = settings_.DirectPhotons();
  if (showsRadiance || (gathers && settings_.radiancePhotons))
    targets.radianceFraction = settings_.radianceFraction;
  return targets;
}

DistantLightTargeting PhotonLighting::Aim(const Scene& scene, const PhotonTargets& targets,
                                          PreprocessContext& context) const {
  // A smaller gain in density does not make up for the less uniform photon weights.
  constexpr double kWorthwhileGain = 4;
  // On average at least this many photons of the smallest map start towards each bounding sphere.
  // They are enough for many density estimates, so that the emission density hardly varies within
  // one estimate.
  constexpr double kLeastPhotons = 2000;
  const auto& lights = scene.Lights();
  const bool hasFarLight = std::any_of(lights.begin(), lights.end(), [](const auto& light) {
    return light->IsFar() && !light->IsProvablyBlack();
  });
  if (!hasFarLight || targets.Least() == 0 || !context.camera) return {};
  DistantLightTargeting aim(VisiblePoints(scene, *context.camera, context.resolution, context.seed),
                            BoundingSphere(scene.WorldBounds()),
                            kLeastPhotons / double(targets.Least()));
  const bool isWorthwhile = aim.Gain() >= kWorthwhileGain;
  if (settings_.photonAim == PhotonAiming::Off) {
    if (isWorthwhile) NoticeUnaimed(aim, context.log);
    return {};
  }
  if (settings_.photonAim == PhotonAiming::Auto && !isWorthwhile) return {};
  ReportAim(aim, context);
  return aim;
}

void PhotonLighting::Preprocess(const Scene& scene, PreprocessContext& context) {
  gathers_ = Gathers(scene);
  lights_ = LightSampler(scene);
  radianceMap_.reset();
  maps_ = {};  // frees the memory of the previous pass
  const PhotonTargets targets = Targets(scene);
  if (BytesOf(targets) > PhysicalMemory()) FailByMemory(targets);
  try {
    Build(scene, targets, context);
  } catch (const std::bad_alloc&) {
    if (BytesOf(targets) == 0) throw;
    maps_ = {};
    FailByMemory(targets);
  }
}

void PhotonLighting::Build(const Scene& scene, const PhotonTargets& targets,
                           PreprocessContext& context) {
  PhotonPassResult result;
  {
    const PhaseTimer timer(context.statistics, "shoot");
    MediaPhotons media(scene, context.volume);
    // Targeting would miss media outside the view, which scatter light towards visible points.
    DistantLightTargeting aim =
        media.Scatter() ? DistantLightTargeting() : Aim(scene, targets, context);
    result = PhotonTracer(scene, settings_, context.seed, std::move(aim), std::move(media))
                 .Shoot(targets, context);
  }
  context.CheckStop();
  NoticeVainCaustics(targets, settings_, scene, context.log);
  ReportPhotonPass(result, targets, settings_, context);
  ReportLights(result, targets, scene, context);
  {
    const PhaseTimer timer(context.statistics, "kd-trees");
    maps_ = PhotonMapSet(&result, settings_, BoundingSphere(scene.WorldBounds()).radius, context);
    if (gathers_) gather_.Prepare(maps_.Map(PhotonKind::Indirect));
  }
  context.CheckStop();
  if (targets.radianceFraction > 0) {
    const PhaseTimer timer(context.statistics, "radiance");
    radianceMap_ =
        std::make_unique<RadiancePhotonMap>(result.sites.Records(), maps_, settings_,
                                            scene.Features().Needs(Feature::Transmission), context);
  }
  ReportMaps(maps_, radianceMap_.get(), settings_, context);
}

void PhotonLighting::RequestSamples(const Scene& scene, SampleLayout* layout) {
  gather_ = FinalGather(settings_);
  if (settings_.finalGather && settings_.show == ShowMap::Nothing)
    gather_.RequestSamples(Gathers(scene), layout);
}

std::string PhotonLighting::GatherText(const Scene& scene, const PhotonTargets& targets) const {
  if (!Gathers(scene)) return "off";
  const std::string rays = std::to_string(settings_.finalGatherSamples) + " rays, ";
  if (settings_.gatherSampling == GatherSampling::Bsdf) return rays + "BSDF only";
  if (targets[PhotonKind::Indirect] == 0) return rays + "BSDF only (0 indirect photons)";
  return rays + "up to half of them round photons' directions";
}

std::vector<std::string> PhotonLighting::Explain(const Scene& scene) const {
  const PhotonTargets targets = Targets(scene);
  const std::string photons = TextOf(targets);
  const auto mebibytes = std::to_string(std::int64_t(BytesOf(targets) / (1 << 20)) + 1);
  return {"photons       " + (photons.empty() ? "none" : photons),
          "gather        " + GatherText(scene, targets),
          "memory        about " + mebibytes + " MiB for the photon maps"};
}

Spectrum PhotonLighting::Direct(const ShadingPoint& point, LiContext& context) const {
  return maps_.Radiance(PhotonKind::Direct, point, &context.arena);
}

Spectrum PhotonLighting::Caustic(const ShadingPoint& point, LiContext& context) const {
  if (!RequiredFeatures::IsCompiled(Feature::Caustics)) return {};
  return maps_.Radiance(PhotonKind::Caustic, point, &context.arena);
}

Spectrum PhotonLighting::Indirect(const ShadingPoint& point, LiContext& context) const {
  if (!gathers_) return maps_.Radiance(PhotonKind::Indirect, point, &context.arena);
  RandomStream random = context.Stream(kGatherStream + std::uint64_t(point.depth));
  return gather_.Gather(point, maps_.Map(PhotonKind::Indirect), context,
                        GatherRay(maps_, radianceMap_.get(), settings_, lights_, context, &random));
}

SurfaceLight PhotonLighting::Shown(const ShadingPoint& point, LiContext& context) const {
  SurfaceLight light;
  switch (settings_.show) {
    case ShowMap::Nothing:
      break;
    case ShowMap::Direct:
      light.direct = Direct(point, context);
      break;
    case ShowMap::Caustic:
      light.caustic = Caustic(point, context);
      break;
    case ShowMap::Indirect:
      light.indirect = maps_.Radiance(PhotonKind::Indirect, point, &context.arena);
      break;
    case ShowMap::Radiance:
      light.indirect = ShownRadiance(point);
      break;
  }
  return light;
}

Spectrum PhotonLighting::ShownRadiance(const ShadingPoint& point) const {
  if (!radianceMap_) return {};
  const RestPose rest(point.surface);
  const Normal3 n = FaceForward(point.surface.ng, point.Wo());
  const auto entry = radianceMap_->Find({rest.Point(point.surface.p), rest.Normal(n)});
  if (!entry) return {};
  const Spectrum value = entry->Value(AbsDot(n, point.Wo()));
  if (settings_.radianceMode == RadianceMode::Exitant) return value;
  return point.bsdf.Rho(LobeSet::DiffuseReflection) * value * kInvPi;
}

AovSet PhotonLighting::Aovs() const {
  AovSet aovs = kLightAovs | AovSet{Aov::PhotonDensity};
  if (settings_.radiancePhotons && settings_.finalGather && settings_.show == ShowMap::Nothing)
    aovs.Add(Aov::RadianceDistance);
  return aovs;
}

void PhotonLighting::Describe(const ShadingPoint& point, LiContext& context) const {
  if (!context.aovs || point.depth != 0) return;
  if (context.aovs->wanted.Has(Aov::PhotonDensity))
    context.aovs->photonDensity = maps_.PhotonDensity(point, &context.arena);
}

std::vector<StoredPhoton> PhotonLighting::PhotonsNear(const Point3& p, const std::string& map,
                                                      int count) const {
  std::vector<StoredPhoton> photons;
  for (const PhotonKind kind : {PhotonKind::Direct, PhotonKind::Caustic, PhotonKind::Indirect}) {
    const PhotonMap& stored = maps_.Map(kind);
    if (map != PhotonKindName(kind) || stored.IsEmpty()) continue;
    Arena arena;
    const NearPoints nearest = stored.Nearest(p, count, &arena);
    std::vector<std::pair<Real, std::uint32_t>> sorted;
    for (std::size_t i = 0; i < nearest.size(); ++i)
      sorted.emplace_back(nearest.distance2[i], nearest.index[i]);
    std::sort(sorted.begin(), sorted.end());
    for (const auto& [distance2, photon] : sorted)
      photons.push_back({map, stored.Position(photon), stored.Direction(photon),
                         stored.Alpha(photon), std::sqrt(distance2)});
  }
  return photons;
}

}  // namespace exphoton
