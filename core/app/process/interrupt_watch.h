// SPDX-License-Identifier: BSD-2-Clause
// InterruptWatch ends the process if it is interrupted, or exceeds the time limit (--limits),
// before there is a result worth keeping. Long work before the first pixel (parsing, building
// accelerators, tracing photons) therefore need not poll the stop flag.
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <optional>
#include <thread>

namespace exphoton::cli {

class InterruptWatch {
 public:
  // Ends the process with status 4 if MustFinish is not set within limitSeconds.
  explicit InterruptWatch(std::optional<double> limitSeconds = {});
  ~InterruptWatch();
  InterruptWatch(const InterruptWatch&) = delete;
  InterruptWatch& operator=(const InterruptWatch&) = delete;

  // Set once there is something to write. The watch then leaves the process alone.
  std::atomic<bool>& MustFinish() { return mustFinish_; }
  // Begins the work for the next result, with the whole time limit.
  void Restart();

 private:
  using Clock = std::chrono::steady_clock;

  void Watch();

  [[noreturn]] void End(const char* message, int status);

  std::optional<double> limitSeconds_;
  std::atomic<bool> mustFinish_{false};
  bool isOver_ = false;
  Clock::time_point start_ = Clock::now();
  std::mutex mutex_;  // guards isOver_ and start_
  std::condition_variable over_;
  std::thread thread_;
};

}  // namespace exphoton::cli
