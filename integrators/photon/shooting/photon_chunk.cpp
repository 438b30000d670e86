// SPDX-License-Identifier: BSD-2-Clause
// Merge counts first, so that all chunks can be copied in parallel.
#include "integrators/photon/shooting/photon_chunk.h"

#include <algorithm>

namespace exphoton {
namespace {

// A store that is filled to this share of its target will probably be filled. It then reserves
// memory for the whole target at once, instead of growing step by step.
constexpr double kShareBeforeReserving = 1. / 16;

// Makes room in the store for the records that recordsOf(chunk) returns, for all chunks. Returns
// the index of each chunk's first record.
template <class RecordsOf, class Record>
std::vector<std::size_t> MakeRoom(std::span<const PhotonChunk> chunks, const RecordsOf& recordsOf,
                                  double wanted, RecordStore<Record>* store) {
  std::vector<std::size_t> first(chunks.size());
  std::size_t count = store->Size();
  for (std::size_t c = 0; c < chunks.size(); ++c) {
    first[c] = count;
    count += recordsOf(chunks[c]).size();
  }
  if (count == store->Size()) return first;
  // The last batch of chunks usually exceeds the target a little, so 1/64 is added.
  if (double(count) >= wanted * kShareBeforeReserving)
    store->Reserve(std::size_t(wanted * (1 + 1. / 64)));
  store->Resize(count);
  return first;
}

template <class Record>
void Copy(const std::vector<Record>& records, std::size_t first, RecordStore<Record>* store) {
  std::copy(records.begin(), records.end(), store->Records().begin() + std::ptrdiff_t(first));
}

}  // namespace

void PhotonChunk::Clear() {
  for (auto& ofMap : photons) ofMap.clear();
  sites.clear();
  samples.clear();
  lights.clear();
  emittedPower = cutPower = squaredGrowth = 0;
  dropped = diverging = skipped = candidates = beyondBound = halvedRays = 0;
  firstDropped = -1;
}

void Merge(std::span<const PhotonChunk> chunks, const PhotonTargets& targets, ThreadPool& threads,
           PhotonPassResult* result) {
  std::array<std::vector<std::size_t>, kPhotonKindCount> first;
  double wanted = 0;
  for (std::size_t m = 0; m < kPhotonKindCount; ++m) {
    wanted += double(targets.counts[m]);
    first[m] = MakeRoom(
        chunks, [m](const PhotonChunk& chunk) -> auto& { return chunk.photons[m]; },
        double(targets.counts[m]), &result->buffers[m].photons);
  }
  const double wantedSites = wanted * double(targets.radianceFraction);
  const std::vector<std::size_t> firstSite = MakeRoom(
      chunks, [](const PhotonChunk& chunk) -> auto& { return chunk.sites; }, wantedSites,
      &result->sites);
  threads.For(std::int64_t(chunks.size()), [&](std::int64_t index, int) {
    const auto c = std::size_t(index);
    for (std::size_t m = 0; m < kPhotonKindCount; ++m)
      Copy<PhotonRecord>(chunks[c].photons[m], first[m][c], &result->buffers[m].photons);
    Copy(chunks[c].sites, firstSite[c], &result->sites);
  });
  for (const PhotonChunk& chunk : chunks) {
    result->emittedPower += chunk.emittedPower;
    result->cutPower += chunk.cutPower;
    // A chunk without dropped photons has firstDropped -1, so the first one with some decides.
    if (result->droppedPhotons == 0) result->firstDroppedPath = chunk.firstDropped;
    result->droppedPhotons += chunk.dropped;
    result->divergingPaths += chunk.diverging;
    result->skipped += chunk.skipped;
    result->candidates += chunk.candidates;
    result->beyondBound += chunk.beyondBound;
    result->halvedRays += chunk.halvedRays;
    result->squaredGrowth += chunk.squaredGrowth;
  }
  result->paths += std::int64_t(chunks.size()) * PhotonTracer::kChunkPaths;
}

}  // namespace exphoton
