// SPDX-License-Identifier: BSD-2-Clause
// PhotonChunk: what the paths of one piece of work leave behind, and how the pieces of a batch
// become part of a result: in their order, whoever traced them.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "core/base/parallel.h"
#include "integrators/photon/shooting/photon_tracer.h"

namespace exphoton {

// Aligned, so that threads that fill neighbours do not wait for each other's lines of the cache.
struct alignas(128) PhotonChunk {
  std::array<std::vector<PhotonRecord>, kPhotonKindCount> photons;
  std::vector<RadiancePhotonSite> sites;
  double emittedPower = 0, cutPower = 0;
  std::int64_t dropped = 0, firstDropped = -1;  // photons; the number of the first one's path
  std::int64_t overgrown = 0, passedBy = 0;

  void Clear();  // keeps its memory
};

// Adds the chunks of a batch, one after the other.
void Merge(std::span<const PhotonChunk> chunks, const PhotonTargets& targets, ThreadPool& threads,
           PhotonPassResult* result);

}  // namespace exphoton
