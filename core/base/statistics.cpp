// SPDX-License-Identifier: BSD-2-Clause
// Statistics collects counts and times. The program formats them.
#include "core/base/statistics.h"

#include <sys/resource.h>
#include <time.h>

#include <fstream>
#include <utility>

namespace exphoton {

const char* RayKindName(RayKind kind) {
  switch (kind) {
    case RayKind::Camera:
      return "camera";
    case RayKind::Shadow:
      return "shadow";
    case RayKind::Bsdf:
      return "bsdf";
    case RayKind::Specular:
      return "specular";
    case RayKind::Gather:
      return "gather";
    case RayKind::Photon:
      return "photon";
  }
  return "";
}

void Statistics::AddRays(const RayCounters& rays) {
  const std::lock_guard lock(mutex_);
  rays_.Add(rays);
}

Statistics::Counter& Statistics::FindCounter(std::string name) {
  for (Counter& counter : counters_)
    if (counter.name == name) return counter;
  return counters_.emplace_back(Counter{std::move(name), 0, {}});
}

void Statistics::SetCounter(std::string name, double value, std::string meaning) {
  const std::lock_guard lock(mutex_);
  Counter& counter = FindCounter(std::move(name));
  counter.value = value;
  counter.meaning = std::move(meaning);
}

void Statistics::AddToCounter(std::string name, double value, std::string meaning) {
  const std::lock_guard lock(mutex_);
  Counter& counter = FindCounter(std::move(name));
  counter.value += value;
  counter.meaning = std::move(meaning);
}

void Statistics::AddPhase(const std::string& name, double wallSeconds, double cpuSeconds) {
  const std::lock_guard lock(mutex_);
  for (Phase& phase : phases_) {
    if (phase.name != name) continue;
    phase.wallSeconds += wallSeconds;
    phase.cpuSeconds += cpuSeconds;
    return;
  }
  phases_.push_back({name, wallSeconds, cpuSeconds});
}

RayCounters Statistics::Rays() const {
  const std::lock_guard lock(mutex_);
  return rays_;
}

std::vector<Statistics::Counter> Statistics::Counters() const {
  const std::lock_guard lock(mutex_);
  return counters_;
}

std::vector<Statistics::Phase> Statistics::Phases() const {
  const std::lock_guard lock(mutex_);
  return phases_;
}

// The constructor registers the phase, so that the destructor does not need to allocate.
PhaseTimer::PhaseTimer(Statistics& statistics, std::string phase)
    : statistics_(statistics), phase_(std::move(phase)) {
  statistics_.AddPhase(phase_, 0, 0);
  wallStart_ = std::chrono::steady_clock::now();
  cpuStart_ = ProcessCpuSeconds();
}

PhaseTimer::~PhaseTimer() {
  const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - wallStart_;
  statistics_.AddPhase(phase_, wall.count(), ProcessCpuSeconds() - cpuStart_);
}

double ProcessCpuSeconds() {
  timespec time{};
  if (clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time) != 0) return 0;
  return double(time.tv_sec) + double(time.tv_nsec) * 1e-9;
}

double PeakMemoryBytes() {
  rusage usage{};
  if (getrusage(RUSAGE_SELF, &usage) != 0) return 0;
  return double(usage.ru_maxrss) * 1024;  // Linux reports KiB
}

// Linux resets the peak to the memory that is used now (proc(5), clear_refs).
void ResetPeakMemory() { std::ofstream("/proc/self/clear_refs") << 5; }

}  // namespace exphoton
