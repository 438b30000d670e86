// SPDX-License-Identifier: BSD-2-Clause
// A thread that looks at the stop flag ten times a second.
#include "core/cli/interrupt_watch.h"

#include <cstdio>
#include <cstdlib>
#include <system_error>

#include "core/cli/signals.h"

namespace exphoton::cli {
namespace {

constexpr std::chrono::milliseconds kInterval(100);
constexpr int kGraceIntervals = 5;  // for what looks at the flag itself

}  // namespace

InterruptWatch::InterruptWatch() {
  try {
    thread_ = std::thread([this] { Watch(); });
  } catch (const std::system_error&) {
    // No thread to be had: an interrupt then waits for the work that is under way.
  }
}

InterruptWatch::~InterruptWatch() {
  {
    const std::lock_guard lock(mutex_);
    isOver_ = true;
  }
  over_.notify_all();
  if (thread_.joinable()) thread_.join();
}

void InterruptWatch::Watch() {
  std::unique_lock lock(mutex_);
  for (int seen = 0; !over_.wait_for(lock, kInterval, [this] { return isOver_; });) {
    if (mustFinish_ || !StopFlag()) continue;
    if (++seen < kGraceIntervals) continue;
    std::fputs("exphoton: interrupted before anything was rendered\n", stderr);
    std::_Exit(128 + SignalNumber());
  }
}

}  // namespace exphoton::cli
