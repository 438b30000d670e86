// SPDX-License-Identifier: BSD-2-Clause
// ShardStatistics is a copy of the statistics of one shard, which a part holds.
#pragma once

#include <vector>

#include "core/base/statistics.h"
#include "core/files/byte_archive.h"

namespace exphoton {

class ShardStatistics {
 public:
  ShardStatistics() = default;
  explicit ShardStatistics(const Statistics& statistics)
      : rays_(statistics.Rays()), counters_(statistics.Counters()), phases_(statistics.Phases()) {}

  void Transfer(ByteArchive* archive) {
    TransferRays(archive, &rays_);
    counters_.resize(archive->Count(counters_.size(), 24));
    for (Statistics::Counter& counter : counters_) {
      archive->Text(&counter.name);
      archive->Values(&counter.value);
      archive->Text(&counter.meaning);
    }
    phases_.resize(archive->Count(phases_.size(), 24));
    for (Statistics::Phase& phase : phases_) {
      archive->Text(&phase.name);
      archive->Values(&phase.wallSeconds, &phase.cpuSeconds);
    }
  }

  // All shards do the same preprocessing, so its rays and counters come from one of them.
  void AddRays(Statistics* statistics) const { statistics->AddRays(rays_); }
  void SetCounters(Statistics* statistics) const {
    for (const Statistics::Counter& counter : counters_)
      statistics->SetCounter(counter.name, counter.value, counter.meaning);
  }
  // The times of all shards add up.
  void AddTimes(Statistics* statistics) const {
    for (const Statistics::Phase& phase : phases_)
      statistics->AddPhase(phase.name, phase.wallSeconds, phase.cpuSeconds);
  }

  static void TransferRays(ByteArchive* archive, RayCounters* rays) {
    for (std::uint64_t& count : rays->counts) archive->Values(&count);
    archive->Values(&rays->cutLightSamples);
    for (ExactSum* sum : {&rays->cutThroughput, &rays->cutGatherThroughput, &rays->cutLight,
                          &rays->cutLightSquares, &rays->cutGatherLight, &rays->gatherLight})
      sum->Transfer(archive);
  }

 private:
  RayCounters rays_;
  std::vector<Statistics::Counter> counters_;
  std::vector<Statistics::Phase> phases_;
};

}  // namespace exphoton
