// SPDX-License-Identifier: BSD-2-Clause
// Begin holds the start times of the work for a picture, and the seconds spent on loading the
// scene.
#pragma once

#include <algorithm>
#include <chrono>

#include "core/base/statistics.h"
#include "core/parser/render_setup.h"

namespace exphoton::cli {

inline double ElapsedSince(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}
inline std::chrono::steady_clock::duration AsDuration(double seconds) {
  return std::chrono::duration_cast<std::chrono::steady_clock::duration>(
      std::chrono::duration<double>(seconds));
}

struct Begin {
  std::chrono::steady_clock::time_point wall = std::chrono::steady_clock::now();
  double cpu = ProcessCpuSeconds();
  double pilotWall = 0, pilotCpu = 0, loadWall = 0, loadCpu = 0;
  int givenUp = 0;                         // attempts after which the picture began again
  double givenUpWall = 0, givenUpCpu = 0;  // seconds of these attempts

  double Wall() const { return ElapsedSince(wall); }
  double Cpu() const { return ProcessCpuSeconds() - cpu; }
  // The pilots of --accuracy come before loading. Later ones may follow a picture that is given up.
  void BeginPilots() { pilotWall -= Wall(), pilotCpu -= Cpu(); }
  void EndPilots() { pilotWall += Wall(), pilotCpu += Cpu(); }
  void BeginAttempt() { attemptWall_ = Wall(), attemptCpu_ = Cpu(); }
  void GiveUpAttempt() {
    ++givenUp;
    givenUpWall += Wall() - attemptWall_, givenUpCpu += Cpu() - attemptCpu_;
  }
  // Loading again, for more photons, is no part of it.
  void EndLoading() {
    if (loadWall > 0) return;
    loadWall = Wall() - pilotWall;
    loadCpu = Cpu() - pilotCpu;
  }
  // Loading the scene file counts towards its first picture.
  void AddLoadingTimes(const RenderSetup& setup, Statistics* statistics) const {
    if (pilotWall > 0) statistics->AddPhase("pilots", pilotWall, pilotCpu);
    if (givenUpWall > 0) statistics->AddPhase("given up", givenUpWall, givenUpCpu);
    const double seconds = loadWall - setup.acceleratorSeconds;
    const double cpuSeconds = loadCpu - setup.acceleratorCpuSeconds;
    statistics->AddPhase("parse", std::max(seconds, 0.), std::max(cpuSeconds, 0.));
    // The pilots may have built it.
    if (setup.acceleratorSeconds > 0)
      statistics->AddPhase("accelerator", setup.acceleratorSeconds, setup.acceleratorCpuSeconds);
  }

 private:
  double attemptWall_ = 0, attemptCpu_ = 0;  // at the beginning of the attempt
};

}  // namespace exphoton::cli
