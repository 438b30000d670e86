// SPDX-License-Identifier: BSD-2-Clause
// ProgressReporter: one bar a phase on standard error, redrawn on a terminal only; elsewhere a line
// for every 10 % or 30 s. Honours NO_COLOR, CLICOLOR_FORCE and TERM=dumb.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <mutex>
#include <string>

namespace exphoton {

class ProgressReporter {
 public:
  enum class Mode { Auto, Quiet };
  explicit ProgressReporter(Mode mode = Mode::Auto);

  // "Shooting photons", "Building photon maps", "Computing photon radiances", "Rendering".
  void Begin(std::string phase, std::int64_t total);
  void Advance(std::int64_t count = 1);  // any thread
  void SetDone(std::int64_t done);       // for phases that learn their progress from outside
  void End();

 private:
  void Draw(bool final);

  Mode mode_;
  bool isTerminal_ = false;
  std::string phase_;
  std::int64_t total_ = 0;
  std::atomic<std::int64_t> done_{0};
  std::chrono::steady_clock::time_point start_, lastDraw_;
  int lastTenth_ = 0;
  std::mutex mutex_;
};

}  // namespace exphoton
