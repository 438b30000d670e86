// SPDX-License-Identifier: BSD-2-Clause
// This file traces the share of one process (chunk_memo.h).
#include "core/base/progress.h"
#include "integrators/photon/shooting/tracer_pass.h"

namespace exphoton {

// Returns whether the counts so far predict the rest of the pass well.
bool PhotonTracer::Pass::IsPredictable() const {
  constexpr std::size_t kEnoughPhotons = 4096;  // their number has a standard error of 2 %
  if (NeedsSamples()) return false;
  for (std::size_t m = 0; m < kPhotonKindCount; ++m)
    if (batch_.open[m] && result_.buffers[m].photons.Size() < kEnoughPhotons && Filled(m) < .25)
      return mayGuideCaustics_ && m == kCaustic && !IsOnlyCausticOpen();
  return true;
}

// Returns the number of paths after which each map will probably be closed, and some more.
std::array<std::int64_t, kPhotonKindCount> PhotonTracer::Pass::PredictClosing() const {
  constexpr double kMargin = 1.03;
  std::array<std::int64_t, kPhotonKindCount> closing{};
  for (std::size_t m = 0; m < kPhotonKindCount; ++m) {
    if (!batch_.open[m]) continue;
    const double stored = double(result_.buffers[m].photons.Size());
    const double paths = double(result_.paths - firstPaths_[m]);
    const double needed = stored > 0 ? paths * double(targets_.counts[m]) / stored : 1e18;
    const double most = double(tracer_.settings_.maxPhotonPaths) + double(kMaxGrownBatchPaths);
    closing[m] = std::int64_t(std::min(double(firstPaths_[m]) + kMargin * needed, most));
  }
  return closing;
}

void PhotonTracer::Pass::TraceShare(int index, int count, ChunkMemo* memo) {
  constexpr std::size_t kTogether = kMaxGrownBatchPaths / kChunkPaths;
  const auto closing = PredictClosing();
  PhotonBatch batch = batch_;
  batch.isRecorded = false;
  std::int64_t chunk = result_.paths / kChunkPaths;
  chunk += (index - 1 - chunk % count + count) % count;
  for (bool isOpen = true; isOpen;) {
    context_.CheckStop();
    std::vector<std::pair<std::int64_t, ChunkState>> group;
    for (; group.size() < kTogether; chunk += count) {
      for (std::size_t m = 0; m < kPhotonKindCount; ++m)
        batch.open[m] = batch_.open[m] && chunk * kChunkPaths < closing[m];
      const bool isCausticsAlone = batch.open == std::array{false, true, false};
      isOpen = std::ranges::count(batch.open, true) > 0 && !(isCausticsAlone && mayGuideCaustics_);
      if (!isOpen) break;
      group.push_back({chunk * kChunkPaths, {batch.open, trainedPath_}});
    }
    chunks_.resize(group.size());
    context_.threads.For(std::int64_t(group.size()), [&](std::int64_t c, int worker) {
      PhotonBatch own = batch;
      own.open = group[std::size_t(c)].second.open;
      std::vector<LightTally> lights;
      PhotonChunk& traced = chunks_[std::size_t(c)];
      tracer_.TraceChunk(group[std::size_t(c)].first, own, &workers_[std::size_t(worker)], &traced,
                         &lights);
      for (std::size_t i = 0; i < lights.size(); ++i)
        if (lights[i].shot > 0) traced.lights.emplace_back(std::int32_t(i), lights[i]);
    });
    for (std::size_t c = 0; c < group.size(); ++c)
      memo->Add(group[c].first, group[c].second, std::move(chunks_[c]));
  }
}

void PhotonTracer::Pass::RunShare(int index, int count, ChunkMemo* memo) {
  if (tracer_.lights_->IsEmpty() && !tracer_.media_.Emit()) return;
  Begin();
  for (std::int64_t batch = kChunkPaths; std::ranges::count(batch_.open, true) > 0;) {
    if (IsOnlyCausticOpen() && mayGuideCaustics_) break;  // the guide depends on all counts
    if (IsPredictable()) {
      TraceShare(index, count, memo);
      break;
    }
    MergeBatch(&batch);
  }
  context_.progress.End();
}

void PhotonTracer::ShootShare(const PhotonTargets& targets, int index, int count,
                              PreprocessContext& context, ChunkMemo* memo) const {
  Pass(*this, targets, context).RunShare(index, count, memo);
}

}  // namespace exphoton
