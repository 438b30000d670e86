// SPDX-License-Identifier: BSD-2-Clause
// ShootPhotons: chooses where photons of distant lights start, traces all photons, and reports.
#include "integrators/photon/photon_pass.h"

#include <algorithm>
#include <filesystem>
#include <memory>

#include "core/base/log.h"
#include "core/files/state_file.h"
#include "integrators/photon/files/photon_file.h"
#include "integrators/photon/files/photon_part.h"
#include "integrators/photon/photon_stats.h"
#include "integrators/photon/shooting/visible_points.h"

namespace exphoton {
namespace {

// Returns the smaller target of the direct and the indirect map, or the target of the caustic map
// if it is the only one. In scenes without caustics, feature culling clears the caustic target, but
// must not change where photons start.
double LeastStableTarget(const PhotonTargets& targets) {
  PhotonTargets others = targets;
  others[PhotonKind::Caustic] = 0;
  return double(others.Least() > 0 ? others.Least() : targets.Least());
}

// Empty where photons of distant lights start towards the whole scene.
DistantLightTargeting ChooseTargeting(const PhotonSettings& settings, const Scene& scene,
                                      const PhotonTargets& targets, const MediaPhotons& media,
                                      PreprocessContext& context) {
  // A smaller gain in density does not make up for the less uniform photon weights.
  constexpr double kWorthwhileGain = 4;
  // On average at least this many photons of the direct and of the indirect map start towards each
  // bounding sphere. They are enough for many density estimates, so that the emission density
  // hardly varies within one estimate.
  constexpr double kMinPhotons = 2000;
  const auto& lights = scene.Lights();
  const bool hasFarLight = std::any_of(lights.begin(), lights.end(), [](const auto& light) {
    return light->IsDistant() && !light->IsProvablyBlack();
  });
  if (!hasFarLight || targets.Least() == 0 || !context.camera) return {};
  const auto refuse = [&](const char* reason) -> DistantLightTargeting {
    if (settings.photonTargeting == PhotonTargeting::On)
      context.log.Notice(std::string("photonaim has no effect") + reason);
    return {};
  };
  // Photons towards visible points are denser and weaker; rejection would undo both.
  if (settings.photonRoulette == PhotonRoulette::Constant)
    return refuse(" with photonroulette \"constant\"");
  // Photons that start towards visible points would miss media beside them, which scatter light
  // towards the camera.
  if (media.Scatter()) return refuse(" in a scene whose media scatter light");
  std::vector<Point3> wanted;
  for (const VisiblePoint& point :
       VisiblePoints(scene, *context.camera, context.resolution, context.seed))
    wanted.push_back(point.p);
  DistantLightTargeting targeting(std::move(wanted), BoundingSphere(scene.WorldBounds()),
                                  kMinPhotons / LeastStableTarget(targets));
  if (targeting.IsEmpty()) return refuse(": the camera sees too few points of the scene");
  const bool isWorthwhile = targeting.Gain() >= kWorthwhileGain;
  if (settings.photonTargeting == PhotonTargeting::Off) {
    if (isWorthwhile) NoticeMissingTargeting(targeting, context.log);
    return {};
  }
  if (settings.photonTargeting == PhotonTargeting::Auto && !isWorthwhile) return {};
  ReportTargeting(targeting, context);
  return targeting;
}

// Returns photons that were shot before.
PhotonPassResult ReadPass(const PhotonSettings& settings, const PhotonTargets& targets,
                          PreprocessContext& context) {
  const PhaseTimer timer(context.statistics, "read photons");
  const PhotonFileUse& use = *context.photonFile;
  PhotonPassResult photons =
      ReadPhotons(use.path, IdentityOfPhotons(use.identity, settings, targets, context.seed));
  ReportReadPhotons(photons, use.path, context);
  return photons;
}

// Returns the chunks of all parts that the user named. `lights` is the number of lights.
std::unique_ptr<ChunkMemo> ReadParts(const PhotonFileUse& use, const PhotonIdentity& identity,
                                     std::size_t lights) {
  auto memo = std::make_unique<ChunkMemo>();
  for (const std::string& path : use.parts) ReadPhotonPart(path, identity, lights, memo.get());
  return memo;
}

// Returns whether the file of a share is there and whole.
bool HasShare(const std::string& path, const PhotonIdentity& identity, std::size_t lights,
              Log& log) {
  if (!std::filesystem::exists(path)) return false;
  try {
    ChunkMemo memo;
    ReadPhotonPart(path, identity, lights, &memo);
    log.Notice("\"" + path + "\" exists already");
    return true;
  } catch (const DamagedState& error) {
    log.Warning(std::string(error.what()) + "; it is replaced");
    return false;
  }
}

// Shoots one share into its file.
void WriteShare(const PhotonTracer& tracer, const PhotonTargets& targets,
                const PhotonIdentity& identity, PreprocessContext& context) {
  const PhotonFileUse& use = *context.photonFile;
  ChunkMemo share;
  tracer.ShootShare(targets, use.shardIndex, use.shardCount, context, &share);
  WritePhotonPart(use.path, identity, &share);
  context.log.Notice("wrote \"" + use.path + "\"");
}

// Shoots the photons for their file, with what the parts hold. Throws PhotonsWritten once a
// share is written.
PhotonPassResult ShootForFile(const PhotonTracer& tracer, const PhotonTargets& targets,
                              const PhotonIdentity& identity, PreprocessContext& context) {
  const PhotonFileUse& use = *context.photonFile;
  const std::size_t lights = tracer.LightCount();
  if (use.shardCount > 0) {
    if (!HasShare(use.path, identity, lights, context.log))
      WriteShare(tracer, targets, identity, context);
    throw PhotonsWritten();
  }
  const auto memo = ReadParts(use, identity, lights);
  PhotonPassResult photons = tracer.Shoot(targets, context, memo.get());
  if (!use.parts.empty())
    context.log.Notice("took " + std::to_string(memo->TakenPaths()) + " of " +
                       std::to_string(photons.paths) + " paths from the parts");
  return photons;
}

}  // namespace

PhotonPassResult ShootPhotons(const Scene& scene, const PhotonSettings& settings,
                              const PhotonTargets& targets, PreprocessContext& context) {
  const PhotonFileUse* const use = context.photonFile;
  if (use && !use->isWritten) return ReadPass(settings, targets, context);
  PhotonPassResult photons;
  {
    const PhaseTimer timer(context.statistics, "shoot");
    MediaPhotons media(scene, context.volume);
    DistantLightTargeting targeting = ChooseTargeting(settings, scene, targets, media, context);
    PhotonTracer tracer(scene, settings, context.seed, std::move(targeting), std::move(media));
    if (context.time) tracer.FixTime(*context.time);
    if (!use) {
      photons = tracer.Shoot(targets, context);
    } else {
      const PhotonIdentity identity =
          IdentityOfPhotons(use->identity, settings, targets, context.seed);
      photons = ShootForFile(tracer, targets, identity, context);
    }
  }
  context.CheckStop();
  NoticeUnusedCaustics(targets, settings, scene, context.log);
  ReportPhotonPass(photons, targets, settings, context);
  ReportLights(photons, targets, scene, context);
  if (!use) return photons;
  const PhaseTimer timer(context.statistics, "write photons");
  WritePhotons(use->path, IdentityOfPhotons(use->identity, settings, targets, context.seed),
               &photons, context.threads);
  throw PhotonsWritten();
}

}  // namespace exphoton
