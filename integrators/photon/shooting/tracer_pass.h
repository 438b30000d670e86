// SPDX-License-Identifier: BSD-2-Clause
// PhotonTracer::Pass is one run of PhotonTracer::Shoot or ShootShare.
#pragma once

#include <algorithm>
#include <optional>
#include <vector>

#include "integrators/photon/shooting/chunk_memo.h"
#include "integrators/photon/shooting/emission/indirect_share.h"
#include "integrators/photon/shooting/photon_chunk.h"
#include "integrators/photon/shooting/photon_path.h"

namespace exphoton {

struct PhotonTracer::Worker {
  Arena arena;
  std::vector<PhotonBranch> branches;
  RayCounters rays;
  std::vector<LightTally> lights;
};

class PhotonTracer::Pass {
 public:
  Pass(const PhotonTracer& tracer, const PhotonTargets& targets, PreprocessContext& context)
      : tracer_(tracer),
        targets_(targets),
        wantedIndirect_(targets[PhotonKind::Indirect]),
        context_(context),
        workers_(std::size_t(context.threads.Count())) {
    for (std::size_t m = 0; m < kPhotonKindCount; ++m) batch_.open[m] = targets.counts[m] > 0;
    batch_.radianceFraction = targets.radianceFraction;
    result_.lights.resize(tracer.scene_.Lights().size());
    for (std::size_t m = 0; m < kPhotonKindCount; ++m) {
      result_.buffers[m].farthest = tracer.farthest_;
      if (tracer.KeepsTimes(PhotonKind(m))) result_.buffers[m].times = tracer.exposure_;
    }
  }

  PhotonPassResult Run(ChunkMemo* memo);
  void RunShare(int index, int count, ChunkMemo* memo);

 private:
  // Smallest number of paths that train a guide.
  static constexpr std::int64_t kMinTrainingPaths = std::int64_t(1) << 14;
  // Largest numbers of samples from before a training: usually, and if too few of them kept
  // photons. A training adds up to 3 kUsualSamples. Samples have 44 bytes and take at most 40 MB.
  static constexpr std::size_t kUsualSamples = std::size_t(1) << 17;
  static constexpr std::size_t kMaxSamples = std::size_t(1) << 19;
  static constexpr std::size_t kCaustic = std::size_t(PhotonKind::Caustic);
  static constexpr std::size_t kIndirect = std::size_t(PhotonKind::Indirect);

  void Trace(std::int64_t paths);
  void TraceOrTake(std::int64_t firstPath, Worker* worker, PhotonChunk* chunk);
  void MergeBatch(std::int64_t* batch);
  void Begin();
  void CloseMaps();
  void CountRays();     // for the display of progress
  double Done() const;  // the part of the work that is done, also for the display

  // Shares
  ChunkState State() const;
  bool NeedsSamples() const;
  bool IsPredictable() const;
  std::array<std::int64_t, kPhotonKindCount> PredictClosing() const;
  void TraceShare(int index, int count, ChunkMemo* memo);
  double Filled(std::size_t map) const;
  bool IsOnlyCausticOpen() const { return batch_.open == std::array{false, true, false}; }

  // Emission guiding
  bool MayGuide(PhotonKind kind) const;
  bool BeginToGuide();
  bool IsWanted(PhotonKind kind);
  std::int64_t MaxTrainingPaths() const;
  void Train(PhotonKind kind);
  void KeepSamples();
  // Returns the number of samples that kept photons, among the first ones.
  std::int64_t KeptPaths(PhotonKind kind, std::size_t first) const;
  EmissionGuide Learn(PhotonKind kind) const;
  void Discard(PhotonKind kind);
  std::vector<SomePhotons> OtherPhotons();
  IndirectShare ShareAtPoints(const std::vector<SomePhotons>& others,
                              std::uint32_t cameraRays) const;
  void LimitIndirect(const std::vector<SomePhotons>& others, std::int64_t trainedPaths);
  void LimitCaustics(std::int64_t wanted, std::int64_t trainedPaths);

  const PhotonTracer& tracer_;
  PhotonTargets targets_;
  std::int64_t wantedIndirect_;  // before LimitIndirect
  PreprocessContext& context_;
  PhotonPassResult result_;
  PhotonBatch batch_;
  std::vector<Worker> workers_;
  std::uint64_t shownRays_ = 0;
  std::vector<PhotonChunk> chunks_;
  double most_ = 0;  // the largest fill of the open maps
  double done_ = 0;  // the largest Done so far: a guide may begin maps anew
  EmissionGuide guide_;
  std::vector<EmissionSample> samples_;
  std::optional<IndirectShare> share_;
  double indirectShare_ = 0;                 // the largest bound of LimitIndirect so far
  std::size_t mostSamples_ = kUsualSamples;  // with this number of samples, no more are kept
  std::array<std::int64_t, kPhotonKindCount> firstPaths_{};  // of the photons in each map
  std::int64_t trainedPath_ = 0;  // number of paths before the last change of the guide
  bool mayGuideIndirect_ = false, mayGuideCaustics_ = false;
  ChunkMemo* memo_ = nullptr;
  std::int64_t attemptAt_ = kMinTrainingPaths;  // number of paths before the next attempt
};

}  // namespace exphoton
