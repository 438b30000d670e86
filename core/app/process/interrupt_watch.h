// SPDX-License-Identifier: BSD-2-Clause
// InterruptWatch: ends the process where it is interrupted before anything is worth keeping, or
// where that takes longer than it may (--limits). Long work before the first pixel (reading,
// building, photons) need not look at the stop flag then.
#pragma once

#include <atomic>
#include <condition_variable>
#include <mutex>
#include <optional>
#include <thread>

namespace exphoton::cli {

class InterruptWatch {
 public:
  // Ends the process with status 4 where MustFinish is not set after limitSeconds.
  explicit InterruptWatch(std::optional<double> limitSeconds = {});
  ~InterruptWatch();
  InterruptWatch(const InterruptWatch&) = delete;
  InterruptWatch& operator=(const InterruptWatch&) = delete;

  // Once set, there is something to write, and the process ends by itself.
  std::atomic<bool>& MustFinish() { return mustFinish_; }

 private:
  void Watch();

  [[noreturn]] void End(const char* message, int status);

  std::optional<double> limitSeconds_;
  std::atomic<bool> mustFinish_{false};
  bool isOver_ = false;
  std::mutex mutex_;
  std::condition_variable over_;
  std::thread thread_;
};

}  // namespace exphoton::cli
