// SPDX-License-Identifier: BSD-2-Clause
// ChunkMemo keeps chunks of photon paths that were traced before, by other processes. A chunk is a
// function of its first path and of the state of the pass. The pass itself decides which chunks it
// needs, so its photons are the same with and without a memo, whatever the memo holds.
//
// A share of the photons is such a memo. Share i of n shoots as usual until the counts predict when
// each map will be full, and then traces the chunks c with c mod n = i - 1 under that prediction.
// Chunks for which the prediction is wrong are traced again by the pass that takes the shares over.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <map>

#include "integrators/photon/shooting/photon_chunk.h"

namespace exphoton {

// ChunkState is what the paths of a chunk depend on, besides their indices.
struct ChunkState {
  std::array<bool, kPhotonKindCount> open{};
  std::int64_t trainedPath = 0;  // number of paths before the last change of the guide

  bool operator==(const ChunkState&) const = default;
};

class ChunkMemo {
 public:
  struct Entry {
    ChunkState state;
    PhotonChunk chunk;
  };

  void Add(std::int64_t firstPath, const ChunkState& state, PhotonChunk chunk) {
    entries_[firstPath] = {state, std::move(chunk)};
  }
  // Moves a chunk out of the memo. Returns false if there is none of this state. Threads may take
  // different chunks at the same time.
  bool Take(std::int64_t firstPath, const ChunkState& state, PhotonChunk* chunk) {
    const auto found = entries_.find(firstPath);
    if (found == entries_.end() || found->second.state != state) return false;
    *chunk = std::move(found->second.chunk);
    ++taken_;
    return true;
  }
  std::int64_t TakenPaths() const { return taken_ * PhotonTracer::kChunkPaths; }
  std::map<std::int64_t, Entry>& Entries() { return entries_; }

 private:
  std::map<std::int64_t, Entry> entries_;  // by first path
  std::atomic<std::int64_t> taken_ = 0;    // chunks
};

}  // namespace exphoton
