// SPDX-License-Identifier: BSD-2-Clause
// PhotonTracer: shoots photons from the lights in numbered batches and sorts what they leave behind
// into buffers. Path i is a function of (seed, i) alone; batches grow from 64 to 4096 paths, and to
// 65536 where maps want far more; they are traced in parallel and merged in order; a buffer counts
// the paths of whole batches only, because stopping at the n-th photon would bias every estimate.
// Jensen 2001, chapter 5.
#pragma once

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "core/transport/integrator.h"
#include "integrators/photon/maps/photon.h"
#include "integrators/photon/photon_settings.h"
#include "integrators/photon/shooting/distant_light_targeting.h"
#include "integrators/photon/shooting/media_photons.h"
#include "integrators/photon/shooting/specular_boxes.h"

namespace exphoton {

// How many photons each map wants; 0: the map is not requested.
struct PhotonTargets {
  std::array<std::int64_t, kPhotonKindCount> counts{};
  Real radianceFraction = 0;  // of the stored photons; 0: no radiance photons

  std::int64_t& operator[](PhotonKind kind) { return counts[std::size_t(kind)]; }
  std::int64_t operator[](PhotonKind kind) const { return counts[std::size_t(kind)]; }
  std::int64_t Least() const {  // of those that are wanted; 0: none is
    std::int64_t least = 0;
    for (const std::int64_t count : counts)
      if (count > 0) least = least > 0 ? std::min(least, count) : count;
    return least;
  }
};

// What became of the paths that left one light.
struct LightTally {
  std::int64_t shot = 0;      // paths
  std::int64_t hit = 0;       // of them, those that met a surface
  std::int64_t passedBy = 0;  // of them, those that were not traced: PhotonPassResult::passedBy
  std::int64_t stored = 0;    // photons, in all maps together

  void Add(const LightTally& other) {
    shot += other.shot;
    hit += other.hit;
    passedBy += other.passedBy;
    stored += other.stored;
  }
};

struct PhotonPassResult {
  std::array<PhotonBuffer, kPhotonKindCount> buffers;
  RecordStore<RadiancePhotonSite> sites;
  std::vector<LightTally> lights;  // in the scene's order
  std::int64_t paths = 0;          // in all
  // Of them, those that were not traced: only the caustic map was open, and they pass all specular
  // surfaces by.
  std::int64_t passedBy = 0;
  double emittedPower = 0;          // luminance, summed over the paths
  double cutPower = 0;              // of it, cut by the depth limit
  std::int64_t droppedPhotons = 0;  // whose power was not finite
  std::int64_t firstDroppedPath = -1;
  std::int64_t overgrownPaths = 0;  // ended because surfaces kept multiplying their power

  PhotonBuffer& operator[](PhotonKind kind) { return buffers[std::size_t(kind)]; }
  const PhotonBuffer& operator[](PhotonKind kind) const { return buffers[std::size_t(kind)]; }
};

struct PhotonChunk;

class PhotonTracer {
 public:
  PhotonTracer(const Scene& scene, const PhotonSettings& settings, std::uint64_t seed,
               DistantLightTargeting aim = {}, MediaPhotons media = {});

  // Shoots until every requested map is full, has had maxphotonpaths, or has stored nothing in its
  // first kFruitlessPaths. Says so once where a map fell short.
  PhotonPassResult Shoot(const PhotonTargets& targets, PreprocessContext& context) const;

  static constexpr std::int64_t kFruitlessPaths = std::int64_t(1) << 19;
  // Paths that one piece of parallel work traces: the smallest batch.
  static constexpr int kChunkPaths = 64;
  // The largest batch while a map may soon be full, and far from that.
  static constexpr std::int64_t kMaxBatchPaths = 4096;
  static constexpr std::int64_t kLargestBatchPaths = 65536;

 private:
  class Path;
  struct Worker {
    Arena arena;
    RayCounters rays;
    std::vector<LightTally> lights;
  };

  void TraceChunk(std::int64_t firstPath, const std::array<bool, kPhotonKindCount>& open,
                  Real radianceFraction, Worker* worker, PhotonChunk* chunk) const;
  // The paths of the batch after one of `last`, when so many have been traced and the fullest of
  // the maps that want more holds this part of what it wants.
  static std::int64_t NextBatch(std::int64_t last, std::int64_t paths, double filled);

  const Scene& scene_;
  PhotonSettings settings_;
  std::uint64_t seed_;
  DistantLightTargeting aim_;
  MediaPhotons media_;
  LightDistribution lights_;
  Real mediaShare_;  // of the paths, those that begin in a medium
  SpecularBoxes specularBoxes_;
  LobeSet lobes_;  // that photons scatter by
  Real farthest_;  // PhotonBuffer::farthest
};

}  // namespace exphoton
