// SPDX-License-Identifier: BSD-2-Clause
// Parts have the sections "photon identity" and "photon chunks".
#include "integrators/photon/files/photon_part.h"

#include <cmath>

#include "core/files/state_file.h"
#include "integrators/photon/files/photon_archive.h"

namespace exphoton {
namespace {

constexpr const char* kChunks = "photon chunks";

bool IsUsable(const PhotonRecord& photon) {
  const Spectrum power = photon.power.Power();
  const Real sum = photon.p.x + photon.p.y + photon.p.z + power.r + power.g + power.b;
  return std::isfinite(sum);
}

void TransferRecord(PhotonRecord* photon, ByteArchive* archive) {
  Spectrum& power = photon->power.Packed();
  archive->Values(&photon->p.x, &photon->p.y, &photon->p.z, &photon->direction, &power.r, &power.g,
                  &power.b);
  if (!IsUsable(*photon)) throw ArchiveError("a photon is not finite");
}

void TransferState(ChunkState* state, ByteArchive* archive) {
  for (bool& open : state->open) Transfer(&open, archive);
  archive->Values(&state->trainedPath);
}

void TransferChunk(PhotonChunk* chunk, ByteArchive* archive) {
  for (auto& photons : chunk->photons) {
    photons.resize(archive->Count(photons.size(), 6 * sizeof(Real) + 4));
    for (PhotonRecord& photon : photons) TransferRecord(&photon, archive);
  }
  chunk->sites.resize(archive->Count(chunk->sites.size(), 13 * sizeof(Real) + 1));
  for (RadiancePhotonSite& site : chunk->sites) Transfer(&site, archive);
  chunk->lights.resize(archive->Count(chunk->lights.size(), 44));
  for (auto& [index, light] : chunk->lights) {
    archive->Values(&index);
    Transfer(&light, archive);
  }
  archive->Values(&chunk->emittedPower, &chunk->cutPower, &chunk->dropped, &chunk->firstDropped,
                  &chunk->diverging, &chunk->skipped, &chunk->candidates, &chunk->beyondBound);
}

}  // namespace

void WritePhotonPart(const std::string& path, const PhotonIdentity& identity, ChunkMemo* memo) {
  StateWriter writer(path);
  WriteIdentity(identity, &writer);
  ByteArchive archive;
  archive.Count(memo->Entries().size(), 16);
  for (auto& [firstPath, entry] : memo->Entries()) {
    std::int64_t first = firstPath;
    archive.Values(&first);
    TransferState(&entry.state, &archive);
    TransferChunk(&entry.chunk, &archive);
  }
  writer.Add(kChunks, archive.Take());
  writer.Commit();
}

void ReadPhotonPart(const std::string& path, const PhotonIdentity& identity, std::size_t lights,
                    ChunkMemo* memo) {
  const StateFile file(path, StateUse::Photons);
  if (!file.Has(kChunks)) file.FailAsDamaged("it is no share of photons");
  CheckIdentity(file, identity);
  file.Read(kChunks, [&](ByteArchive* archive) {
    for (std::size_t left = archive->Count(0, 16); left > 0; --left) {
      std::int64_t first = 0;
      ChunkState state;
      PhotonChunk chunk;
      archive->Values(&first);
      TransferState(&state, archive);
      TransferChunk(&chunk, archive);
      for (const auto& [index, light] : chunk.lights)
        if (std::size_t(index) >= lights) throw ArchiveError("a light does not exist");
      memo->Add(first, state, std::move(chunk));
    }
  });
}

}  // namespace exphoton
