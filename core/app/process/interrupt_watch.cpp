// SPDX-License-Identifier: BSD-2-Clause
// InterruptWatch polls the stop flag ten times a second, in a thread.
#include "core/app/process/interrupt_watch.h"

#include <cstdio>
#include <cstdlib>
#include <system_error>

#include "core/app/process/signals.h"
#include "core/base/error.h"
#include "core/files/temporary_file.h"

namespace exphoton::cli {
namespace {

constexpr std::chrono::milliseconds kInterval(100);
constexpr int kGraceIntervals = 5;  // time for code that polls the stop flag to end first

}  // namespace

InterruptWatch::InterruptWatch(std::optional<double> limitSeconds) : limitSeconds_(limitSeconds) {
  try {
    thread_ = std::thread([this] { Watch(); });
  } catch (const std::system_error&) {
    // Without a thread, an interrupt takes effect only after the current work.
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

void InterruptWatch::Restart() {
  const std::lock_guard lock(mutex_);
  start_ = Clock::now();
  mustFinish_ = false;
}

void InterruptWatch::End(const char* message, int status) {
  std::fputs(message, stderr);
  RemoveTemporaryFiles();
  std::_Exit(status);
}

void InterruptWatch::Watch() {
  std::unique_lock lock(mutex_);
  for (int seen = 0; !over_.wait_for(lock, kInterval, [this] { return isOver_; });) {
    if (mustFinish_) continue;
    const double seconds = std::chrono::duration<double>(Clock::now() - start_).count();
    if (limitSeconds_ && seconds > *limitSeconds_)
      End("exphoton: error: the time limit of --limits is exceeded\n", int(ExitStatus::Resource));
    if (!StopFlag() || ++seen < kGraceIntervals) continue;
    End("exphoton: interrupted before anything was rendered\n", 128 + SignalNumber());
  }
}

}  // namespace exphoton::cli
