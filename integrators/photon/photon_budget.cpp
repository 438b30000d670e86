// SPDX-License-Identifier: BSD-2-Clause
// ChooseTargets decides how many photons each map needs. The other functions estimate and describe
// these numbers.
#include "integrators/photon/photon_budget.h"

#include <algorithm>

#include "core/base/error.h"
#include "core/base/memory.h"
#include "core/transport/specular/caustic_lights.h"
#include "integrators/photon/maps/photon_map.h"
#include "integrators/photon/maps/walls.h"
#include "integrators/photon/radiance/radiance_photon_map.h"

namespace exphoton {
namespace {

bool HasReceiver(const Scene& scene) {
  return Intersects(scene.Primitives().PossibleLobes(), LobeSet::NonSpecular);
}

std::string GatherText(const PhotonSettings& settings, const Scene& scene,
                       const PhotonTargets& targets) {
  if (!GathersIndirectLight(settings, scene)) return "off";
  const std::string rays = std::to_string(settings.finalGatherSamples) + " rays, ";
  if (settings.gatherSampling == GatherSampling::Bsdf) return rays + "BSDF only";
  if (targets[PhotonKind::Indirect] == 0) return rays + "BSDF only (0 indirect photons)";
  if (settings.gatherSampling == GatherSampling::Jensen)
    return rays + "half of them by a histogram of photons (Jensen)";
  if (settings.gatherSampling == GatherSampling::Hey)
    return rays + "half of them by footprints of photons (Hey and Purgathofer)";
  return rays + "up to half of them round photons' directions";
}

// Paths that begin in media are not guided. The indirect map, which they fill, therefore needs
// paths without a guide. A scene with media always has a volume integrator.
bool HasEmittingMedium(const Scene& scene) {
  return scene.HasMedia() && std::any_of(scene.Media().begin(), scene.Media().end(),
                                         [](const auto& medium) { return medium->Emits(); });
}

std::string EmissionText(const PhotonSettings& settings, const Scene& scene,
                         const PhotonTargets& targets) {
  if (!settings.guideEmission) return "not guided (guideemission false)";
  if (settings.photonRoulette == PhotonRoulette::Constant)
    return "not guided (photonroulette \"constant\")";
  std::string maps;
  if (targets[PhotonKind::Caustic] > 0) maps = "caustic";
  const bool hasIndirect = targets[PhotonKind::Indirect] > 0;
  if (hasIndirect && !HasEmittingMedium(scene)) maps += maps.empty() ? "indirect" : " and indirect";
  if (maps.empty())
    return hasIndirect ? "not guided (a medium emits photons)"
                       : "not guided (no caustic or indirect photons)";
  return "guided for " + maps + " photons, if few paths leave any";
}

const char* WallsText(const PhotonSettings& settings, const Scene& scene) {
  if (!settings.hidePhotons) return "hide no photons: hidephotons is off";
  return Walls(scene).Exist() ? "hide photons from points behind them"
                              : "hide no photons: a shape moves";
}

}  // namespace

bool GathersIndirectLight(const PhotonSettings& settings, const Scene& scene) {
  return settings.finalGather && settings.show == ShowMap::Nothing &&
         scene.Features().Needs(Feature::Indirect);
}

PhotonTargets ChooseTargets(const PhotonSettings& settings, const Scene& scene) {
  const ShowMap show = settings.show;
  const bool showsAll = show == ShowMap::Nothing || show == ShowMap::Radiance;
  const bool gathers = GathersIndirectLight(settings, scene);
  const bool showsRadiance = show == ShowMap::Radiance;
  const bool hasIndirect = scene.Features().Needs(Feature::Indirect);
  const bool hasLight = scene.NonBlackLightCount() > 0;  // media fill only the indirect map
  PhotonTargets targets;
  const bool hasCaustics =
      hasLight && settings.CausticPhotons() > 0 && scene.Features().Needs(Feature::Caustics) &&
      scene.Features().Needs(Feature::Specular) && !CausticLights(scene).AreImpossible();
  if (hasCaustics && (showsAll || show == ShowMap::Caustic))
    targets[PhotonKind::Caustic] = settings.CausticPhotons();
  if (hasIndirect && (showsAll || show == ShowMap::Indirect))
    targets[PhotonKind::Indirect] = settings.indirectPhotons;
  if (hasLight && ((hasIndirect && (gathers || showsRadiance)) ||
                   (HasReceiver(scene) &&
                    ((settings.directWithPhotons && showsAll) || show == ShowMap::Direct))))
    targets[PhotonKind::Direct] = settings.DirectPhotons();
  if (showsRadiance || (gathers && settings.radiancePhotons))
    targets.radianceFraction = settings.radianceFraction;
  return targets;
}

std::string TextOf(const PhotonTargets& targets) {
  std::string text;
  for (const PhotonKind kind : {PhotonKind::Direct, PhotonKind::Caustic, PhotonKind::Indirect}) {
    if (targets[kind] == 0) continue;
    text += (text.empty() ? "" : ", ") + std::to_string(targets[kind]) + " " + PhotonKindName(kind);
  }
  return text;
}

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

std::vector<std::string> ExplainBudget(const PhotonSettings& settings, const Scene& scene) {
  const PhotonTargets targets = ChooseTargets(settings, scene);
  const std::string photons = TextOf(targets);
  const auto mebibytes = std::to_string(std::int64_t(BytesOf(targets) / (1 << 20)) + 1);
  std::vector<std::string> lines{"photons       " + (photons.empty() ? "none" : photons),
                                 "gather        " + GatherText(settings, scene, targets),
                                 "memory        about " + mebibytes + " MiB for the photon maps",
                                 "emission      " + EmissionText(settings, scene, targets),
                                 "walls         " + std::string(WallsText(settings, scene))};
  const int dark = CausticLights(scene).OutOfReachCount();
  if (scene.Features().Needs(Feature::Caustics) && dark > 0)
    lines.push_back("proofs        no caustics of " + std::to_string(dark) + " of " +
                    std::to_string(scene.NonBlackLightCount()) +
                    " lights, which shine away from all specular surfaces");
  return lines;
}

}  // namespace exphoton
