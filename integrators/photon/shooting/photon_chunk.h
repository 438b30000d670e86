// SPDX-License-Identifier: BSD-2-Clause
// PhotonChunk collects the photons of one parallel task, and Merge appends the chunks of a batch to
// the result. The chunks are merged in order, so the result does not depend on the threads.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "core/base/parallel.h"
#include "integrators/photon/shooting/emission/emission_training.h"
#include "integrators/photon/shooting/photon_tracer.h"

namespace exphoton {

// Alignment avoids false sharing: neighbouring chunks are filled by different threads.
struct alignas(128) PhotonChunk {
  std::array<std::vector<PhotonRecord>, kPhotonKindCount> photons;
  std::vector<RadiancePhotonSite> sites;
  std::vector<EmissionSample> samples;  // one for each path from a light, if paths are recorded
  // Of the lights with paths in this chunk, if they are asked for: index and tally.
  std::vector<std::pair<std::int32_t, LightTally>> lights;
  double emittedPower = 0, cutPower = 0;
  std::int64_t dropped = 0, firstDropped = -1;  // photons; path index of the first one
  std::int64_t diverging = 0, skipped = 0;
  std::int64_t candidates = 0, beyondBound = 0, halvedRays = 0;  // see PhotonPassResult
  double squaredGrowth = 0;                                      // the same

  void Clear();  // keeps the memory
};

// Appends the chunks of a batch in order.
void Merge(std::span<const PhotonChunk> chunks, const PhotonTargets& targets, ThreadPool& threads,
           PhotonPassResult* result);

}  // namespace exphoton
