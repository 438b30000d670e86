// SPDX-License-Identifier: BSD-2-Clause
// The two passes of photon mapping.
#include "integrators/photon/photon_integrator.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <new>

#include "core/base/memory.h"
#include "integrators/photon/certificate/caustic_rays.h"
#include "integrators/photon/certificate/gather_correction.h"
#include "integrators/photon/gather/gather_ray.h"
#include "integrators/photon/maps/rest_pose.h"
#include "integrators/photon/photon_pass.h"
#include "integrators/photon/photon_stats.h"

namespace exphoton {
namespace {

// The maps in the order of PhotonMapNames.
constexpr std::array kListedMaps{PhotonKind::Indirect, PhotonKind::Direct, PhotonKind::Caustic};

// Returns the share of the stored photons that become radiance photons. A disk of a smaller area
// keeps its number of radiance photons, so that most hits find one within its reach. If there are
// not enough photons, gather rays use density estimates instead.
Real FractionForDisks(Real fraction, double diskArea) {
  const double wanted = double(fraction) / diskArea;
  return wanted <= 1 ? Real(wanted) : Real(0);
}

}  // namespace

PhotonIntegrator::PhotonIntegrator(const PhotonSettings& settings)
    : settings_(settings),
      direct_(settings.directLights.value_or(DirectLighting::kMostLights),
              settings.directLights.value_or(DirectLighting::kChosenLights)),
      gather_(settings),
      correctionGuide_(settings.gatherPhotons, Cone(Radians(settings.gatherAngle))) {}

void PhotonIntegrator::Preprocess(const Scene& scene, PreprocessContext& context) {
  // Release the memory of an earlier pass
  radianceMap_.reset();
  causticCorrection_.reset();
  maps_ = {};

  gathers_ = GathersIndirectLight(settings_, scene);
  lights_ = scene.MakeLightSampler(LightSelection::Auto);
  PhotonTargets targets = ChooseTargets(settings_, scene);
  targets.radianceFraction = FractionForDisks(targets.radianceFraction, context.diskArea);
  if (BytesOf(targets) > PhysicalMemory()) FailByMemory(targets);
  try {
    PhotonPassResult photons = ShootPhotons(scene, settings_, targets, context);
    BuildMaps(scene, &photons, context);
    if (targets.radianceFraction > 0) ComputeRadiancePhotons(scene, &photons, context);
  } catch (const std::bad_alloc&) {
    if (BytesOf(targets) == 0) throw;
    maps_ = {};
    FailByMemory(targets);
  }
  ReportMaps(maps_, radianceMap_.get(), settings_, context);
}

void PhotonIntegrator::BuildMaps(const Scene& scene, PhotonPassResult* photons,
                                 PreprocessContext& context) {
  const PhaseTimer timer(context.statistics, "photon maps");
  const Real sceneRadius = BoundingSphere(scene.WorldBounds()).radius;
  const Walls walls = settings_.hidePhotons ? Walls(scene) : Walls();
  maps_ = PhotonMapSet(photons, settings_, sceneRadius, context, walls);
  if (gathers_) {
    gather_.Prepare(maps_.Map(PhotonKind::Indirect));
    correctionGuide_.Prepare(maps_.Map(PhotonKind::Indirect));
  }
  causticCorrection_ = std::make_unique<CausticCorrection>(scene, maps_, settings_);
  context.CheckStop();
}

void PhotonIntegrator::ComputeRadiancePhotons(const Scene& scene, PhotonPassResult* photons,
                                              PreprocessContext& context) {
  const PhaseTimer timer(context.statistics, "radiance");
  radianceMap_ =
      std::make_unique<RadiancePhotonMap>(photons->sites.Records(), maps_, settings_,
                                          scene.Features().Needs(Feature::Transmission), context);
}

void PhotonIntegrator::RequestSamples(const Scene& scene, const Sampler& sampler,
                                      SampleLayout* layout) {
  if (!settings_.directWithPhotons) direct_.RequestSamples(scene, sampler, layout);
  if (settings_.finalGather && settings_.show == ShowMap::Nothing)
    gather_.RequestSamples(GathersIndirectLight(settings_, scene), layout);
}

Spectrum PhotonIntegrator::Li(const RayDifferential& ray, LiContext& context) const {
  return SpecularTree(settings_.maxDepth, context, lights_.get())
      .Radiance(ray, [&](const ShadingPoint& point) {
        if (settings_.show != ShowMap::Nothing)
          return Shown(point, context).Collect(point, context);
        FillDensity(point, context);
        const SurfaceLight light{point.Le(), Direct(point, context), Caustic(point, context),
                                 Indirect(point, context)};
        if (context.correction && causticCorrection_->Guide())
          causticCorrection_->Correct(point, light, context);
        return light.Collect(point, context);
      });
}

Spectrum PhotonIntegrator::Direct(const ShadingPoint& point, LiContext& context) const {
  if (settings_.directWithPhotons) return Seen(PhotonKind::Direct, point, context);
  return direct_.AllLights(point, context);
}

Spectrum PhotonIntegrator::Caustic(const ShadingPoint& point, LiContext& context) const {
  if (!RequiredFeatures::IsCompiled(Feature::Caustics)) return {};
  return Seen(PhotonKind::Caustic, point, context);
}

Spectrum PhotonIntegrator::Seen(PhotonKind kind, const ShadingPoint& point,
                                LiContext& context) const {
  Spectrum signedRadiance, radiance;
  Spectrum* const sign = context.signedLight ? &signedRadiance : nullptr;
  const auto isTraced = [&] { return kind == PhotonKind::Caustic && causticCorrection_->Guide(); };
  if (context.correction && !isTraced()) {
    const auto corrected = maps_.Corrected(kind, point, &context.arena, LobeSet::NonSpecular, sign);
    context.correction->sum += point.throughput * corrected.correction;
    radiance = corrected.radiance;
  } else {
    radiance = maps_.Radiance(kind, point, &context.arena, LobeSet::NonSpecular, sign);
  }
  if (context.signedLight) *context.signedLight += point.throughput * signedRadiance;
  return radiance;
}

Spectrum PhotonIntegrator::Indirect(const ShadingPoint& point, LiContext& context) const {
  if (!gathers_) return Seen(PhotonKind::Indirect, point, context);
  RandomStream random = context.Stream(kGatherRayStream + std::uint64_t(point.depth));
  GatherRay rays(maps_, radianceMap_.get(), settings_, *lights_, context, &random);
  if (!context.correction) return gather_.Gather(point, context, rays);
  const CorrectionSources sources{maps_,    radianceMap_.get(), settings_,
                                  *lights_, correctionGuide_,   causticCorrection_->Guide()};
  GatherCorrection correction(sources, context);
  rays.SetObserver(&correction);
  return gather_.Gather(point, context, rays);
}

SurfaceLight PhotonIntegrator::Shown(const ShadingPoint& point, LiContext& context) const {
  SurfaceLight light;
  switch (settings_.show) {
    case ShowMap::Nothing:
      break;
    case ShowMap::Direct:
      light.direct = maps_.Radiance(PhotonKind::Direct, point, &context.arena);
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

Spectrum PhotonIntegrator::ShownRadiance(const ShadingPoint& point) const {
  if (!radianceMap_) return {};
  const RestPose rest(point.surface);
  const Normal3 n = FaceForward(point.surface.ng, point.Wo());
  const auto entry = radianceMap_->Find({rest.Point(point.surface.p), rest.Normal(n)});
  if (!entry) return {};
  return entry->Value(AbsDot(n, point.Wo()));
}

std::optional<CertificationLimits> PhotonIntegrator::Certification(const Scene& scene) const {
  if (settings_.show != ShowMap::Nothing) return std::nullopt;
  const auto needs = [&](Feature feature) { return scene.Features().Needs(feature); };
  CertificationLimits limits;
  const auto add = [&](const std::string& text) { limits.notCovered.push_back(text); };
  if (needs(Feature::Specular))
    add("paths with more than " + std::to_string(settings_.maxDepth) +
        " specular bounces in a row (maxdepth)");
  if (needs(Feature::Caustics) && settings_.CausticPhotons() == 0)
    add("caustics (causticphotons is 0)");
  else if (needs(Feature::Caustics) && !CausticRaysFindAll(scene))
    add("the kernel's blur of caustics where they change within the search radius");
  else if (needs(Feature::Caustics))
    add("the kernel's blur of caustics if rays rarely find their lights");
  if (settings_.directWithPhotons)
    add("the blur of the direct map where light changes within the search radius");
  if (!settings_.finalGather && needs(Feature::Indirect))
    add("the blur of the indirect map where light changes within the search radius");
  return limits;
}

FeatureSet PhotonIntegrator::ComputedFeatures() const {
  FeatureSet computed = FeatureSet::All();
  const bool showsAll = settings_.show == ShowMap::Nothing;
  const bool hasRadiance = (showsAll && settings_.finalGather && settings_.radiancePhotons) ||
                           settings_.show == ShowMap::Radiance;
  if (!hasRadiance) computed = computed.Without(kPhotonMapFeatures);
  if (settings_.CausticPhotons() == 0) computed = computed.Without({Feature::Caustics});
  if (settings_.indirectPhotons == 0 && !settings_.finalGather)
    computed = computed.Without({Feature::Indirect});
  return computed;
}

std::vector<std::string> PhotonIntegrator::Explain(const Scene& scene) const {
  return ExplainBudget(settings_, scene);
}

AovSet PhotonIntegrator::Aovs() const {
  AovSet aovs = kLightAovs | AovSet{Aov::PhotonDensity};
  if (settings_.radiancePhotons && settings_.finalGather && settings_.show == ShowMap::Nothing)
    aovs.Add(Aov::RadianceDistance);
  if (settings_.sharedGather && settings_.finalGather && settings_.show == ShowMap::Nothing)
    aovs.Add(Aov::SharingBias);
  return aovs;
}

void PhotonIntegrator::FillDensity(const ShadingPoint& point, LiContext& context) const {
  if (!context.aovs || point.depth != 0) return;
  if (context.aovs->wanted.Has(Aov::PhotonDensity))
    context.aovs->photonDensity = maps_.PhotonDensity(point, &context.arena);
}

std::vector<std::string> PhotonIntegrator::PhotonMapNames() const {
  std::vector<std::string> names;
  for (const PhotonKind kind : kListedMaps) names.push_back(PhotonKindName(kind));
  return names;
}

std::vector<StoredPhoton> PhotonIntegrator::PhotonsNear(const Point3& p, std::size_t map,
                                                        int count) const {
  const PhotonMap& photonMap = maps_.Map(kListedMaps.at(map));
  if (photonMap.IsEmpty()) return {};
  Arena arena;
  const NearPoints nearest = photonMap.Nearest(p, count, &arena);
  std::vector<std::pair<Real, std::uint32_t>> sorted;
  for (std::size_t i = 0; i < nearest.size(); ++i)
    sorted.emplace_back(nearest.distance2[i], nearest.index[i]);
  std::sort(sorted.begin(), sorted.end());
  std::vector<StoredPhoton> photons;
  for (const auto& [distance2, photon] : sorted)
    photons.push_back({photonMap.Position(photon), photonMap.Direction(photon),
                       photonMap.Alpha(photon), std::sqrt(distance2)});
  return photons;
}

}  // namespace exphoton
