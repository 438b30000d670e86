// SPDX-License-Identifier: BSD-2-Clause
// Merging: counting first, so that all chunks can be copied at the same time.
#include "integrators/photon/photon_chunk.h"

#include <algorithm>

namespace exphoton {
namespace {

// A map that holds this part of its target gets memory for the whole.
constexpr std::int64_t kShareBeforeReserving = 16;

void MergePhotons(std::span<const PhotonChunk> chunks, std::size_t map, std::int64_t target,
                  ThreadPool& threads, BlockStore<PhotonBlock>* photons) {
  std::vector<std::size_t> first(chunks.size());
  std::size_t count = photons->Size();
  for (std::size_t c = 0; c < chunks.size(); ++c) {
    first[c] = count;
    count += chunks[c].photons[map].size();
  }
  if (count == photons->Size()) return;
  // From here on it will hardly stay empty: memory for all, once, and for the last batch.
  if (std::int64_t(count) >= target / kShareBeforeReserving)
    photons->Reserve(std::size_t(target + target / 64));
  photons->Resize(count);
  const std::span<PhotonRecord> records = photons->Records();
  threads.For(std::int64_t(chunks.size()), [&](std::int64_t c, int) {
    const auto& from = chunks[std::size_t(c)].photons[map];
    std::copy(from.begin(), from.end(), records.begin() + std::ptrdiff_t(first[std::size_t(c)]));
  });
}

}  // namespace

void PhotonChunk::Clear() {
  for (auto& ofMap : photons) ofMap.clear();
  seeds.clear();
  emittedPower = cutPower = 0;
  dropped = overgrown = 0;
  firstDropped = -1;
}

void Merge(std::span<const PhotonChunk> chunks, const PhotonTargets& targets, ThreadPool& threads,
           PhotonHarvest* harvest) {
  for (std::size_t m = 0; m < kPhotonKindCount; ++m)
    MergePhotons(chunks, m, targets.counts[m], threads, &harvest->hauls[m].photons);
  for (const PhotonChunk& chunk : chunks) {
    harvest->seeds.insert(harvest->seeds.end(), chunk.seeds.begin(), chunk.seeds.end());
    for (const PathTally& path : chunk.paths) {
      LightTally& light = harvest->lights[std::size_t(path.light)];
      ++light.shot;
      light.hit += path.hasHit;
      light.stored += path.stored;
    }
    harvest->emittedPower += chunk.emittedPower;
    harvest->cutPower += chunk.cutPower;
    if (harvest->droppedPhotons == 0) harvest->firstDroppedPath = chunk.firstDropped;
    harvest->droppedPhotons += chunk.dropped;
    harvest->overgrownPaths += chunk.overgrown;
  }
  harvest->paths += std::int64_t(chunks.size()) * PhotonTracer::kChunkPaths;
}

}  // namespace exphoton
