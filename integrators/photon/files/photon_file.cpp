// SPDX-License-Identifier: BSD-2-Clause
// Photon files have the sections "photon identity" and "photon pass", one of blocks for each map,
// and "radiance sites".
#include "integrators/photon/files/photon_file.h"

#include <cmath>
#include <cstdio>

#include "core/files/state_file.h"
#include "integrators/photon/files/photon_archive.h"
#include "integrators/photon/maps/photon_map_set.h"

namespace exphoton {
namespace {

constexpr const char* kPass = "photon pass";
constexpr const char* kSites = "radiance sites";

std::string BlocksName(PhotonKind kind) { return PhotonKindName(kind) + std::string(" photons"); }

template <class Visit>
void ForEachKind(const Visit& visit) {
  for (int kind = 0; kind < kPhotonKindCount; ++kind) visit(PhotonKind(kind));
}

std::string Text(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.9g", value);
  return text;
}

// Transfers all but the photons themselves and the sites. counts: photons of each map.
void Transfer(PhotonPassResult* pass, std::array<std::uint64_t, kPhotonKindCount>* counts,
              ByteArchive* archive) {
  ForEachKind([&](PhotonKind kind) {
    PhotonBuffer& buffer = (*pass)[kind];
    archive->Values(&(*counts)[std::size_t(kind)], &buffer.paths, &buffer.farthest);
    archive->Values(&buffer.times.min, &buffer.times.max);
    Transfer(&buffer.isGuided, archive);
  });
  pass->lights.resize(archive->Count(pass->lights.size(), 40));
  for (LightTally& light : pass->lights) Transfer(&light, archive);
  archive->Values(&pass->paths, &pass->guidedPaths, &pass->trainingPaths, &pass->skipped,
                  &pass->emittedPower, &pass->cutPower, &pass->droppedPhotons,
                  &pass->firstDroppedPath, &pass->divergingPaths, &pass->candidates,
                  &pass->beyondBound);
}

void Transfer(RecordStore<RadiancePhotonSite>* sites, ByteArchive* archive) {
  sites->Resize(archive->Count(sites->Size(), 13 * sizeof(Real) + 1));
  for (RadiancePhotonSite& site : sites->Records()) Transfer(&site, archive);
}

// A file that was written on purpose to do harm can have any numbers and a matching checksum.
bool IsFinite(const PhotonBlock& block) {
  Real sum = 0;
  for (std::uint32_t lane = 0; lane < kBlockPoints; ++lane) {
    const Point3 p = block.Position(lane);
    const Spectrum alpha = block.Alpha(lane);
    sum += (p.x - p.x) + (p.y - p.y) + (p.z - p.z) + (alpha.r - alpha.r) + (alpha.g - alpha.g) +
           (alpha.b - alpha.b);
  }
  return sum == 0;
}

BlockStore<PhotonBlock> ReadBlocks(const StateFile& file, PhotonKind kind, std::uint64_t count) {
  const MappedBytes mapped = file.Map(BlocksName(kind));
  if (count > PointBvh::kMaxPoints ||
      mapped.bytes.size() != (count + kBlockPoints - 1) / kBlockPoints * sizeof(PhotonBlock))
    file.FailAsDamaged("its number of photons does not fit");
  if (count == 0) return {};
  BlockStore<PhotonBlock> photons(mapped.bytes.data(), std::size_t(count), mapped.owner);
  for (std::size_t i = 0; i < photons.BlockCount(); ++i)
    if (!IsFinite(photons.Blocks()[i])) file.FailAsDamaged("a photon is not finite");
  return photons;
}

}  // namespace

PhotonIdentity IdentityOfPhotons(const PhotonIdentity& scene, const PhotonSettings& settings,
                                 const PhotonTargets& targets, std::uint64_t seed) {
  PhotonIdentity identity = scene;
  const auto add = [&](const char* name, const std::string& value) {
    identity.emplace_back(name, value);
  };
  add("--seed", std::to_string(seed));
  ForEachKind([&](PhotonKind kind) {
    add((PhotonKindName(kind) + std::string("photons")).c_str(), std::to_string(targets[kind]));
  });
  add("radiancefraction", Text(double(targets.radianceFraction)));
  add("maxphotondepth", std::to_string(settings.maxPhotonDepth));
  add("maxphotonpaths", std::to_string(settings.maxPhotonPaths));
  add("guideemission", settings.guideEmission ? "true" : "false");
  if (settings.guideEmission && !settings.causticPhotons) add("number of causticphotons", "chosen");
  add("lightselection", settings.lightSelection == LightSelection::Power ? "power" : "uniform");
  constexpr std::array kRoulettes{"luminance", "maxcomponent", "constant", "half"};
  add("photonroulette", kRoulettes[std::size_t(settings.photonRoulette)]);
  return identity;
}

void WritePhotons(const std::string& path, const PhotonIdentity& identity,
                  PhotonPassResult* photons, ThreadPool& threads) {
  std::array<std::uint64_t, kPhotonKindCount> counts;
  ForEachKind(
      [&](PhotonKind kind) { counts[std::size_t(kind)] = (*photons)[kind].photons.Size(); });
  auto trees = MakePhotonTrees(photons->buffers, threads);
  ForEachKind([&](PhotonKind kind) {
    PhotonBuffer& buffer = (*photons)[kind];
    buffer.photons = std::move(trees[std::size_t(kind)]).TakeBlocks();
    buffer.isSorted = true;
  });

  StateWriter writer(path);
  const auto add = [&](const char* name, const auto& transfer) {
    ByteArchive archive;
    transfer(&archive);
    writer.Add(name, archive.Take());
  };
  WriteIdentity(identity, &writer);
  add(kPass, [&](ByteArchive* archive) { Transfer(photons, &counts, archive); });
  add(kSites, [&](ByteArchive* archive) { Transfer(&photons->sites, archive); });
  ForEachKind([&](PhotonKind kind) {
    writer.AddAligned(BlocksName(kind), (*photons)[kind].photons.Bytes());
  });
  writer.Commit();
}

PhotonPassResult ReadPhotons(const std::string& path, const PhotonIdentity& identity) {
  const StateFile file(path, StateUse::Photons);
  CheckIdentity(file, identity);
  PhotonPassResult photons;
  std::array<std::uint64_t, kPhotonKindCount> counts{};
  file.Read(kPass, [&](ByteArchive* archive) { Transfer(&photons, &counts, archive); });
  file.Read(kSites, [&](ByteArchive* archive) { Transfer(&photons.sites, archive); });
  ForEachKind([&](PhotonKind kind) {
    PhotonBuffer& buffer = photons[kind];
    buffer.photons = ReadBlocks(file, kind, counts[std::size_t(kind)]);
    buffer.isSorted = true;
    if (!std::isfinite(buffer.times.min + buffer.times.max))
      file.FailAsDamaged("the exposure of its photons is not finite");
    if (buffer.photons.Size() > 0 && !(buffer.paths > 0 && std::isfinite(buffer.farthest)))
      file.FailAsDamaged("its number of paths does not fit");
  });
  return photons;
}

}  // namespace exphoton
