// SPDX-License-Identifier: BSD-2-Clause
// This file writes the notices, warnings and counters of the photon pass.
#include "integrators/photon/photon_stats.h"

#include <cmath>
#include <sstream>
#include <string>

#include "core/base/log.h"
#include "integrators/photon/photon_budget.h"

namespace exphoton {
namespace {

// Most lights that get rows in the table of counters, and most notices about lights.
constexpr std::size_t kMaxListedLights = 64;
constexpr int kMaxLightNotices = 5;
// A light with fewer paths than this may miss a small scene by chance.
constexpr std::int64_t kSignificantPaths = 1000;

// Share of the emitted power that the depth limit may cut without a warning.
constexpr double kMaxUnreportedCut = 1e-3;

template <class... Parts>
std::string Text(const Parts&... parts) {
  std::ostringstream out;
  (out << ... << parts);
  return out.str();
}

// Returns a name such as "2 spot". Lights are counted from 1 in file order.
std::string LightName(const Scene& scene, std::size_t i) {
  const std::string& plugin = scene.OriginOfLight(i).plugin;
  return Text(i + 1, plugin.empty() ? "" : " ", plugin);
}

bool HasStoredNothing(const LightTally& light, const PhotonTargets& targets) {
  if (light.shot < kSignificantPaths || light.stored > 0) return false;
  // If only caustic photons are wanted, a light without caustics is normal.
  return light.hit + light.skipped == 0 || targets[PhotonKind::Direct] > 0 ||
         targets[PhotonKind::Indirect] > 0;
}

// With survival probability 1/2, the squared power grows by the factor 2 albedo^2 in a bounce. In a
// closed room of an albedo above .71 its mean is infinite.
void ReportGrowth(const PhotonPassResult& result, Log& log) {
  constexpr std::int64_t kFewRays = 1000;
  constexpr double kBounded = 1.02;  // a sum of random numbers may exceed 1 by chance
  if (result.halvedRays < kFewRays) return;
  const double growth = result.squaredGrowth / double(result.halvedRays);
  if (!(growth > kBounded)) return;
  log.Notice(Text("photonroulette \"half\": the squared power of a photon grows by a factor of ",
                  std::round(100 * growth) / 100,
                  " in a bounce on average, so few photons have most of the light of many bounces"),
             {}, "\"string photonroulette\" \"luminance\" keeps the powers nearly equal");
}

void NoticeUnstoredLights(const PhotonPassResult& result, const PhotonTargets& targets,
                          const Scene& scene, Log& log) {
  int found = 0;
  for (std::size_t i = 0; i < result.lights.size(); ++i) {
    const LightTally& light = result.lights[i];
    if (!HasStoredNothing(light, targets) || ++found > kMaxLightNotices) continue;
    const LightOrigin& origin = scene.OriginOfLight(i);
    log.Notice(Text("light ", i + 1, origin.plugin.empty() ? "" : " (" + origin.plugin + ")",
                    " has shot ", light.shot, " photons and none was stored"),
               origin.where,
               light.hit + light.skipped == 0
                   ? "they hit nothing: check the light's position and direction"
                   : "they hit surfaces, but left no photons of a kind that the maps still needed");
  }
  if (found > kMaxLightNotices)
    log.Notice(Text(found - kMaxLightNotices, " more lights shot photons and none was stored"));
}

void ReportPaths(const PhotonPassResult& result, PreprocessContext& context) {
  context.statistics.AddToCounter("photons/shot", double(result.paths),
                                  "paths that left the lights");
  if (result.skipped > 0)
    context.statistics.AddToCounter(
        "photons/skipped", double(result.skipped),
        "of these, paths for caustics only that were not traced because "
        "they miss all specular surfaces");
  if (result.guidedPaths > 0)
    context.statistics.AddToCounter("photons/guided", double(result.guidedPaths),
                                    "of these, paths whose emission was guided");
  if (result.trainingPaths > 0)
    context.statistics.AddToCounter("photons/training", double(result.trainingPaths),
                                    "of these, paths that only trained the guide");
  const std::int64_t unguided = result.paths - result.guidedPaths;
  if (unguided > 0)
    context.statistics.SetCounter("photons/emitted power", result.emittedPower / double(unguided),
                                  "luminance of the power that the lights emit, as shot");
}

// Reports how the number of caustic photons compares with the light that they carry.
void ReportEnoughCaustics(const PhotonPassResult& result, const PhotonSettings& settings,
                          PreprocessContext& context) {
  constexpr std::int64_t kMuchMore = 4;
  const std::int64_t enough = result.enoughCaustics;
  if (enough == 0) return;
  context.statistics.SetCounter("photons/caustic enough", double(enough),
                                "caustic photons that are worth their time");
  const std::int64_t wanted = settings.causticPhotons.value_or(0);
  if (wanted < kMuchMore * enough) return;
  context.log.Notice(
      Text("causticphotons ", wanted, ": caustics carry little of the light here, and about ",
           enough, " photons are enough"),
      {}, "without \"causticphotons\" the number follows from the light of the caustics");
}

// Reports that the indirect map is smaller than wanted, and why.
void ReportEnoughIndirect(const PhotonPassResult& result, const PhotonTargets& targets,
                          PreprocessContext& context) {
  if (result.enoughIndirect == 0) return;
  context.statistics.SetCounter("photons/indirect wanted", double(targets[PhotonKind::Indirect]),
                                "photons that the indirect map would have if more of the light "
                                "were indirect");
  context.log.Verbose(Text("indirect map: ", result.enoughIndirect, " instead of ",
                           targets[PhotonKind::Indirect],
                           " photons, because little of the light is indirect"));
}

// Returns the number of photons that the map should have.
std::int64_t TargetOf(PhotonKind kind, const PhotonPassResult& result, const PhotonTargets& targets,
                      const PhotonSettings& settings) {
  if (kind == PhotonKind::Indirect && result.enoughIndirect > 0) return result.enoughIndirect;
  const bool isChosen = kind == PhotonKind::Caustic && !settings.causticPhotons;
  return isChosen && result.enoughCaustics > 0 ? result.enoughCaustics : targets[kind];
}

// Reports what the proofs of CausticLights saved.
void ReportProofs(const PhotonPassResult& result, PreprocessContext& context) {
  if (result.outOfReach == 0) return;
  context.statistics.AddToCounter("photons/out of reach", double(result.outOfReach),
                                  "of the skipped paths, those of lights that shine away from "
                                  "all specular surfaces; nothing was emitted");
  context.log.Verbose(Text("proofs: ", result.outOfReach, " of ", result.paths,
                           " paths were not emitted, because their lights make no caustics"));
}

}  // namespace

void NoticeUnusedCaustics(const PhotonTargets& targets, const PhotonSettings& settings,
                          const Scene& scene, Log& log) {
  const RequiredFeatures& plan = scene.Features();
  if (plan.Needs(Feature::Caustics) || targets[PhotonKind::Caustic] > 0) return;
  if (settings.causticPhotons.value_or(0) == 0) return;
  log.Notice(Text("causticphotons ", *settings.causticPhotons,
                  ": no photons are shot for caustics (", plan.Get(Feature::Caustics).reason, ")"));
}

void ReportTargeting(const DistantLightTargeting& targeting, PreprocessContext& context) {
  context.statistics.SetCounter(
      "photons/targeting gain", targeting.Gain(),
      "how much denser photons of distant lights start towards visible points");
  context.log.Notice(Text("photons of distant lights start towards visible points, ",
                          std::llround(targeting.Gain()), " times denser than everywhere"),
                     {}, "\"string photonaim\" \"off\" spreads them over the whole scene");
}

void NoticeMissingTargeting(const DistantLightTargeting& targeting, Log& log) {
  log.Notice(
      Text("photons of distant lights are spread over the whole scene: where the camera looks "
           "they are sparse, and light is missing behind glass and in corners"),
      {},
      Text("\"string photonaim\" \"auto\" makes them about ", std::llround(targeting.Gain()),
           " times as dense there"));
}

void ReportPhotonPass(const PhotonPassResult& result, const PhotonTargets& targets,
                      const PhotonSettings& settings, PreprocessContext& context) {
  ReportEnoughCaustics(result, settings, context);
  ReportEnoughIndirect(result, targets, context);
  for (const PhotonKind kind : {PhotonKind::Direct, PhotonKind::Caustic, PhotonKind::Indirect}) {
    if (targets[kind] == 0) continue;
    const PhotonBuffer& buffer = result[kind];
    const std::string name = PhotonKindName(kind);
    context.statistics.AddToCounter("photons/" + name + " stored", double(buffer.photons.Size()),
                                    "photons in the " + name + " map, of all passes together");
    context.statistics.AddToCounter("photons/" + name + " paths", double(buffer.paths),
                                    "paths from the lights that the " + name + " map counts");
    const std::int64_t target = TargetOf(kind, result, targets, settings);
    if (std::int64_t(buffer.photons.Size()) < target)
      context.log.Notice(Text(name, " map: ", buffer.photons.Size(), " of ", target,
                              " photons after ", buffer.paths, " paths"));
  }
  ReportPaths(result, context);
  if (settings.photonRoulette == PhotonRoulette::Constant) {
    context.statistics.AddToCounter(
        "photons/candidates", double(result.candidates),
        "samples that photonroulette \"constant\" accepted or rejected");
    context.statistics.AddToCounter("photons/beyond bound", double(result.beyondBound),
                                    "of these, accepted with more than the constant luminance");
  }
  ReportGrowth(result, context.log);
  if (result.cutPower > kMaxUnreportedCut * result.emittedPower)
    context.log.Warning(
        Text("maxphotondepth ", settings.maxPhotonDepth, " cut ",
             100 * result.cutPower / result.emittedPower, " % of the emitted power"),
        {}, "raise \"maxphotondepth\", or lower reflectances that are (nearly) 1");
  if (result.divergingPaths > 0)
    context.log.Warning(
        Text(result.divergingPaths, " photon paths were ended: their power grew without bound"), {},
        "a surface reflects more light than it receives");
  if (result.droppedPhotons == 0) return;
  context.statistics.AddToCounter("photons/non-finite", double(result.droppedPhotons),
                                  "photons lost because their power was not finite");
  if (context.isStrict)
    throw Error(ExitStatus::Internal, Text("photon path ", result.firstDroppedPath, " of seed ",
                                           context.seed, " has a power that is not finite"));
  context.log.Warning(Text(result.droppedPhotons, " photons had no finite power and were lost"));
}

void ReportReadPhotons(const PhotonPassResult& result, const std::string& path,
                       PreprocessContext& context) {
  PhotonTargets stored;
  for (const PhotonKind kind : {PhotonKind::Direct, PhotonKind::Caustic, PhotonKind::Indirect}) {
    const std::string name = PhotonKindName(kind);
    stored[kind] = std::int64_t(result[kind].photons.Size());
    if (stored[kind] > 0)
      context.statistics.AddToCounter("photons/" + name + " read", double(stored[kind]),
                                      "photons of the " + name + " map, from the file");
  }
  const std::string counts = TextOf(stored);
  context.log.Notice(Text("photons from \"", path, "\": ", counts.empty() ? "none" : counts));
}

void ReportLights(const PhotonPassResult& result, const PhotonTargets& targets, const Scene& scene,
                  PreprocessContext& context) {
  if (result.paths == 0) return;
  LightTally rest;
  for (std::size_t i = 0; i < result.lights.size(); ++i) {
    const LightTally& light = result.lights[i];
    if (scene.Lights()[i]->IsProvablyBlack()) continue;
    if (i >= kMaxListedLights) {
      rest.shot += light.shot;
      rest.stored += light.stored;
      continue;
    }
    const std::string name = "lights/" + LightName(scene, i);
    context.statistics.AddToCounter(name + " shot", double(light.shot), "paths from this light");
    context.statistics.AddToCounter(name + " stored", double(light.stored),
                                    "photons that they left, in all maps");
  }
  if (rest.shot > 0) {
    context.statistics.AddToCounter("lights/further shot", double(rest.shot),
                                    "paths from lights that are not listed");
    context.statistics.AddToCounter("lights/further stored", double(rest.stored),
                                    "photons that they left, in all maps");
  }
  ReportProofs(result, context);
  NoticeUnstoredLights(result, targets, scene, context.log);
}

void ReportMaps(const PhotonMapSet& maps, const RadiancePhotonMap* radianceMap,
                const PhotonSettings& settings, PreprocessContext& context) {
  double bytes = 0;
  std::string chosen;
  for (const PhotonKind kind : {PhotonKind::Direct, PhotonKind::Caustic, PhotonKind::Indirect}) {
    if (maps.Map(kind).IsEmpty()) continue;
    const std::string name = PhotonKindName(kind);
    bytes += double(maps.Map(kind).MemoryBytes());
    context.statistics.SetCounter("photons/" + name + " maxdist", double(maps.MaxDistance(kind)),
                                  "largest radius of an estimate in the " + name + " map");
    chosen += Text(chosen.empty() ? "" : ", ", name, " ", maps.MaxDistance(kind));
  }
  if (!settings.maxDist && !chosen.empty())
    context.log.Notice(
        "maxdist chosen from the photons: " + chosen, {},
        "it is the distance within which nine of ten photons have nused neighbours; \"float "
        "maxdist\" sets it for all maps");
  if (radianceMap) {
    bytes += double(radianceMap->MemoryBytes());
    context.statistics.SetCounter("photons/radiance photons", double(radianceMap->Size()),
                                  "places with precomputed radiance");
  }
  context.statistics.SetCounter("photons/memory", bytes, "memory of all photon maps");
}

}  // namespace exphoton
