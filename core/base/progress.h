// SPDX-License-Identifier: BSD-2-Clause
// ProgressReporter shows one progress bar per phase on standard error. On a terminal it redraws the
// bar in place. Elsewhere, and with TERM=dumb, it prints a line for every 10 % or 30 s.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <mutex>
#include <string>
#include <utility>

namespace exphoton {

class ProgressReporter {
 public:
  enum class Mode { Auto, Quiet };
  explicit ProgressReporter(Mode mode = Mode::Auto);

  // Starts a phase, such as "Shooting photons", "Building photon maps", "Computing photon
  // radiances" or "Rendering". `total` is the count at which it is complete.
  void Begin(std::string phase, std::int64_t total);
  void Advance(std::int64_t count = 1);  // callable from any thread
  void SetDone(std::int64_t done);       // sets the absolute count
  void End();
  // Calls `listener` after each change of a phase, from any thread. For phases that belong to a
  // longer one. Must be set before the first phase.
  void SetListener(std::function<void()> listener) { listener_ = std::move(listener); }

 private:
  void Draw(bool final);

  Mode mode_;
  std::function<void()> listener_;
  bool isTerminal_ = false;
  std::string phase_;
  std::int64_t total_ = 0;
  std::atomic<std::int64_t> done_{0};
  std::chrono::steady_clock::time_point start_, lastDraw_;
  int lastTenth_ = 0;
  std::mutex mutex_;
};

}  // namespace exphoton
