// SPDX-License-Identifier: BSD-2-Clause
// ProgressReporter shows the progress of a render on standard error: one bar over all phases of all
// its pictures, which is redrawn in place on a terminal. Elsewhere, and with TERM=dumb, it prints
// lines by time: the first after 5 s, then one for each further tenth, at most one in 10 s.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace exphoton {

class ProgressReporter {
 public:
  enum class Mode { Auto, Quiet };
  using Seconds = std::function<double()>;  // a clock with any origin
  // Tests pass a clock of their own.
  explicit ProgressReporter(Mode mode = Mode::Auto, Seconds clock = {});

  // Begins picture `index` of `count`, from 0: the next phases belong to it. All pictures share one
  // bar and are expected to take the same time. Must be called between phases. A render that does
  // not call it has one picture.
  void BeginPicture(int index, int count);
  // Starts a phase, such as "Shooting photons" or "Rendering". `total` is the count at which it is
  // complete. "Rendering" is the last phase of a picture and has most of its bar. The earlier
  // phases share the first fifth of it, and until the last phase begins, the time left is estimated
  // as if they took a fifth of the time.
  void Begin(std::string phase, std::int64_t total);
  void Advance(std::int64_t count = 1);  // callable from any thread
  void SetDone(std::int64_t done);       // sets the absolute count
  // Erases the bar. A phase of a second or more leaves a line with its time on a terminal.
  void End();
  // Calls `listener` after each change of a phase, from any thread. For phases that belong to a
  // longer one. Must be set before the first phase.
  void SetListener(std::function<void()> listener) { listener_ = std::move(listener); }

  // Adds traced rays, for the display of rays per second. Callable from any thread.
  void CountRays(std::uint64_t count) { rays_.fetch_add(count, std::memory_order_relaxed); }
  // Returns the rays since the last call, for a reporter of the longer phase. Callable from any
  // thread.
  std::uint64_t TakeRays() { return rays_.exchange(0, std::memory_order_relaxed); }
  // Sets texts that the display ends with, such as "12 samples a pixel" and "noise 1.8 %". A
  // terminal that is too narrow for all of them loses the last ones first.
  void SetDetails(std::vector<std::string> details);
  // Sets whether the time left is shown as "about" so much.
  void SetRough(bool isRough) { isRough_.store(isRough, std::memory_order_relaxed); }
  bool IsQuiet() const { return mode_ == Mode::Quiet; }

  // Part describes how much is done.
  struct Part {
    double done = 0;           // of the current picture
    double ofPhase = 0;        // of the current phase
    double phaseSeconds = 0;   // since the current phase began
    bool isRendering = false;  // whether the current phase is the last one
  };
  // Returns a description of now. Callable from a listener.
  Part Done() const;

  static constexpr double kPreparationShare = .2;  // of a picture, for all phases before the last

 private:
  struct Moment {
    double fraction;             // of the bar
    double elapsed;              // seconds of all phases so far
    std::optional<double> left;  // estimated seconds to the end
    bool isRough;                // whether the estimate is
  };
  Part DoneAt(double now) const;
  Moment Now() const;
  bool IsLineDue(const Moment& now);
  void Draw();
  void DrawBar(const Moment& now) const;
  void PrintLine(const Moment& now) const;
  std::string Rate() const;  // rays per second in this phase; "" if none were counted
  std::vector<std::string> Extras() const;  // the details and the rate, without empty ones

  Mode mode_;
  std::function<void()> listener_;
  Seconds clock_;
  bool isTerminal_ = false;
  std::string phase_;
  std::vector<std::string> details_;
  std::int64_t total_ = 0;
  std::atomic<std::int64_t> done_{0};
  std::atomic<std::uint64_t> rays_{0};
  std::atomic<bool> isRough_{false};
  bool hasBegun_ = false;  // whether the current picture has a phase
  int picture_ = 0, pictureCount_ = 1;
  std::optional<double> start_;  // seconds, as the next members; absent before the first phase
  double pictureStart_ = 0, phaseStart_ = 0, lastDraw_ = 0;
  double phaseFrom_ = 0, phaseTo_ = 0;  // the part of the picture's bar that this phase has
  int lastTenth_ = 0;
  mutable std::mutex mutex_;
};

}  // namespace exphoton
