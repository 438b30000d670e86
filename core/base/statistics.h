// SPDX-License-Identifier: BSD-2-Clause
// Statistics collects ray counts by kind, seconds by phase and named counters. Each thread counts
// into its own RayCounters, which are merged at the end. Counting never changes the computed
// result.
#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <mutex>
#include <string>
#include <vector>

#include "core/base/exact_sum.h"

namespace exphoton {

enum class RayKind { Camera, Shadow, Bsdf, Specular, Gather, Photon };
inline constexpr int kRayKindCount = 6;
const char* RayKindName(RayKind kind);  // "camera"

struct RayCounters {
  std::array<std::uint64_t, kRayKindCount> counts{};
  // Sums the throughput (luminance) of specular camera paths that a depth limit cut. Compare it
  // with the number of camera rays.
  ExactSum cutThroughput;
  ExactSum cutGatherThroughput;  // the same for gather rays
  // Some camera samples measure the luminance that they lose at a depth limit (cut_light.h).
  std::uint64_t cutLightSamples = 0;   // number of these samples
  ExactSum cutLight, cutLightSquares;  // the latter: sum of the squares, for the standard error
  // The same for paths that gather indirect light, and the luminance that these paths found.
  ExactSum cutGatherLight, gatherLight;

  void Count(RayKind kind) { ++counts[std::size_t(kind)]; }
  std::uint64_t Total() const {
    std::uint64_t total = 0;
    for (const std::uint64_t count : counts) total += count;
    return total;
  }
  void Add(const RayCounters& other) {
    for (std::size_t i = 0; i < counts.size(); ++i) counts[i] += other.counts[i];
    cutThroughput += other.cutThroughput;
    cutGatherThroughput += other.cutGatherThroughput;
    cutLightSamples += other.cutLightSamples;
    cutLight += other.cutLight;
    cutLightSquares += other.cutLightSquares;
    cutGatherLight += other.cutGatherLight;
    gatherLight += other.gatherLight;
  }
};

class Statistics {
 public:
  struct Counter {
    std::string name;  // "photons/caustic stored"
    double value;
    std::string meaning;  // one line of explanation
  };
  struct Phase {
    std::string name;  // "shoot"
    double wallSeconds, cpuSeconds;
  };

  void AddRays(const RayCounters& rays);  // callable from any thread
  void SetCounter(std::string name, double value, std::string meaning);
  // Adds to the counter's value, for work that a render may do several times.
  void AddToCounter(std::string name, double value, std::string meaning);
  void AddPhase(const std::string& name, double wallSeconds, double cpuSeconds);

  RayCounters Rays() const;
  std::vector<Counter> Counters() const;
  std::vector<Phase> Phases() const;  // in order of their first run

 private:
  Counter& FindCounter(std::string name);  // the caller holds the mutex

  mutable std::mutex mutex_;
  RayCounters rays_;
  std::vector<Counter> counters_;
  std::vector<Phase> phases_;
};

// PhaseTimer adds the time from its construction to its destruction to a phase.
class PhaseTimer {
 public:
  PhaseTimer(Statistics& statistics, std::string phase);
  ~PhaseTimer();

 private:
  Statistics& statistics_;
  std::string phase_;
  std::chrono::steady_clock::time_point wallStart_;
  double cpuStart_ = 0;
};

double ProcessCpuSeconds();
double PeakMemoryBytes();  // of this process so far, in physical memory
void ResetPeakMemory();    // PeakMemoryBytes then begins anew, where the system allows it

}  // namespace exphoton
