// SPDX-License-Identifier: BSD-2-Clause
// PhotonTracer traces photons from lights and emitting media in numbered batches, and sorts the
// stored photons into one buffer per map (Jensen 2001, chapter 5). Path i depends on (seed, i)
// alone. Batches grow from 64 to 4096 paths, or to 65536 while every open map is far from full;
// they are traced in parallel and merged in order. A map is closed only at the end of a batch, and
// its N counts whole batches. Closing it at its last wanted photon would bias every estimate.
#pragma once

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "core/transport/integrator.h"
#include "core/transport/specular/caustic_lights.h"
#include "core/transport/specular/specular_boxes.h"
#include "integrators/photon/maps/photon.h"
#include "integrators/photon/photon_settings.h"
#include "integrators/photon/shooting/distant_light_targeting.h"
#include "integrators/photon/shooting/media_photons.h"
#include "integrators/photon/shooting/photon_rejection.h"

namespace exphoton {

// PhotonTargets holds the target count of each map. A map with target 0 is not requested.
struct PhotonTargets {
  std::array<std::int64_t, kPhotonKindCount> counts{};
  Real radianceFraction = 0;  // share of the stored photons that become radiance photon sites

  std::int64_t& operator[](PhotonKind kind) { return counts[std::size_t(kind)]; }
  std::int64_t operator[](PhotonKind kind) const { return counts[std::size_t(kind)]; }
  std::int64_t Least() const {  // smallest target above 0; 0: there is none
    std::int64_t least = 0;
    for (const std::int64_t count : counts)
      if (count > 0) least = least > 0 ? std::min(least, count) : count;
    return least;
  }
};

// LightTally counts the results of the paths that left one light.
struct LightTally {
  std::int64_t shot = 0;     // paths
  std::int64_t hit = 0;      // paths that hit a surface
  std::int64_t skipped = 0;  // paths that were not traced: see PhotonPassResult::skipped
  std::int64_t stored = 0;   // photons, in all maps together
  std::int64_t caustic = 0;  // of these, in the caustic map

  void Add(const LightTally& other) {
    shot += other.shot;
    hit += other.hit;
    skipped += other.skipped;
    stored += other.stored;
    caustic += other.caustic;
  }
};

struct PhotonPassResult {
  std::array<PhotonBuffer, kPhotonKindCount> buffers;
  RecordStore<RadiancePhotonSite> sites;
  std::vector<LightTally> lights;  // in the scene's order
  std::int64_t paths = 0;          // of all lights and media
  std::int64_t guidedPaths = 0;    // of these, paths whose emission was guided
  std::int64_t trainingPaths = 0;  // of these, paths that only trained the guide
  // Caustic photons that resolve caustics finely enough (Pass::LimitCaustics); 0: not known.
  std::int64_t enoughCaustics = 0;
  // Indirect photons that are enough, because little of the light is indirect (eq. 7e); 0: all that
  // are wanted.
  std::int64_t enoughIndirect = 0;
  // Paths that were counted but not traced, because only the caustic map was open and the first ray
  // missed all specular surfaces.
  std::int64_t skipped = 0;
  std::int64_t outOfReach = 0;  // of these, paths of lights that make no caustics (CausticLights)
  // Both over the paths that are not guided.
  double emittedPower = 0;          // luminance, summed over the paths
  double cutPower = 0;              // luminance of the photons that the depth limit ended
  std::int64_t droppedPhotons = 0;  // their power was not finite
  std::int64_t firstDroppedPath = -1;
  std::int64_t divergingPaths = 0;  // ended because surfaces kept multiplying their power
  // With photonroulette "constant": samples of lights, surfaces and media that were accepted or
  // rejected, and accepted samples above one unit of luminance, because their bound was unknown or
  // too low.
  std::int64_t candidates = 0, beyondBound = 0;
  // With photonroulette "half": rays of photons that roulette may end, and the sum over these rays
  // of the growth of the squared power in a bounce. 0 for chunks of other processes.
  std::int64_t halvedRays = 0;
  double squaredGrowth = 0;

  PhotonBuffer& operator[](PhotonKind kind) { return buffers[std::size_t(kind)]; }
  const PhotonBuffer& operator[](PhotonKind kind) const { return buffers[std::size_t(kind)]; }
};

struct PhotonChunk;
class ChunkMemo;
class EmissionGuide;

// PhotonBatch describes paths that are traced in the same way.
struct PhotonBatch {
  std::array<bool, kPhotonKindCount> open{};  // maps that store photons
  Real radianceFraction = 0;
  const EmissionGuide* guide = nullptr;  // null: emission is not guided
  bool isRecorded = false;               // each path reports its emission to the training
  bool isDiscarded = false;              // photons are not kept
};

class PhotonTracer {
 public:
  PhotonTracer(const Scene& scene, const PhotonSettings& settings, std::uint64_t seed,
               DistantLightTargeting targeting = {}, MediaPhotons media = {});

  // Traces until every requested map is full, has used maxphotonpaths, or has stored nothing in its
  // first kFruitlessPaths.
  // `memo` has chunks that other processes have traced; null: none.
  PhotonPassResult Shoot(const PhotonTargets& targets, PreprocessContext& context,
                         ChunkMemo* memo = nullptr) const;

  // Traces the share of one process (chunk_memo.h) into the memo.
  void ShootShare(const PhotonTargets& targets, int index, int count, PreprocessContext& context,
                  ChunkMemo* memo) const;

  // Lets all paths start at one point of the exposure, in [0,1).
  void FixTime(Real u);

  // Returns whether the photons of this map keep their times instead of their distances. If shapes
  // move, so may caustics, and gathers do not follow their photons to their origins.
  bool KeepsTimes(PhotonKind kind) const {
    return kind == PhotonKind::Caustic && shapesMove_ && exposure_.min < exposure_.max;
  }

  std::size_t LightCount() const { return scene_.Lights().size(); }

  static constexpr std::int64_t kFruitlessPaths = std::int64_t(1) << 19;
  // Paths per parallel task; also the smallest batch.
  static constexpr int kChunkPaths = 64;
  // Largest batch while a map may soon be full, and while all maps are far from full.
  static constexpr std::int64_t kMaxBatchPaths = 4096;
  static constexpr std::int64_t kMaxGrownBatchPaths = 65536;

 private:
  class Path;
  class Pass;
  struct Worker;

  // `lights` receives the tallies.
  void TraceChunk(std::int64_t firstPath, const PhotonBatch& batch, Worker* worker,
                  PhotonChunk* chunk, std::vector<LightTally>* lights) const;
  // Returns the size of the next batch. last: the previous size; paths: traced so far; filled: how
  // full the fullest open map is, the larger of its share of the photon target and its share of
  // maxphotonpaths.
  static std::int64_t NextBatch(std::int64_t last, std::int64_t paths, double filled);

  // Returns the eight bits that a photon keeps beside its direction.
  std::uint8_t PayloadOf(PhotonKind kind, const Photon& photon, Real time) const;

  const Scene& scene_;
  PhotonSettings settings_;
  std::uint64_t seed_;
  Interval exposure_;  // times at which paths start
  bool shapesMove_;    // during the exposure
  DistantLightTargeting targeting_;
  MediaPhotons media_;
  std::unique_ptr<const FixedLightSampler> lights_;
  Real mediaShare_;  // share of the paths that begin in a medium
  PhotonRejection rejection_;
  SpecularBoxes specularBoxes_;
  CausticLights causticLights_;
  LobeSet lobes_;  // lobes that scatter photons
  Real farthest_;  // see PhotonBuffer::farthest
};

}  // namespace exphoton
