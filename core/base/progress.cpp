// SPDX-License-Identifier: BSD-2-Clause
// ProgressReporter draws the progress bar. The remaining time assumes that the rest runs at the
// average speed so far.
#include "core/base/progress.h"

#include <algorithm>
#include <cstdio>
#include <utility>

#include "core/base/terminal.h"

namespace exphoton {
namespace {

using Clock = std::chrono::steady_clock;
constexpr std::chrono::milliseconds kRedrawInterval(100);
constexpr std::chrono::seconds kLineInterval(30);

double SecondsSince(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

// Formats a duration as "7.3 s", "2 min 05 s" or "3 h 20 min".
std::string DurationText(double seconds) {
  char text[64];
  const auto whole = static_cast<long long>(std::min(seconds, 1e12));
  if (seconds < 60) {
    std::snprintf(text, sizeof text, "%.1f s", seconds);
  } else if (whole < 3600) {
    std::snprintf(text, sizeof text, "%lld min %02lld s", whole / 60, whole % 60);
  } else {
    std::snprintf(text, sizeof text, "%lld h %02lld min", whole / 3600, whole / 60 % 60);
  }
  return text;
}

void Write(const std::string& text) {
  std::fwrite(text.data(), 1, text.size(), stderr);
  std::fflush(stderr);
}

}  // namespace

ProgressReporter::ProgressReporter(Mode mode) : mode_(mode), isTerminal_(IsRedrawable()) {}

void ProgressReporter::Begin(std::string phase, std::int64_t total) {
  const std::lock_guard lock(mutex_);
  phase_ = std::move(phase);
  total_ = std::max<std::int64_t>(total, 1);
  done_ = 0;
  lastTenth_ = 0;
  start_ = lastDraw_ = Clock::now();
  if (isTerminal_) Draw(false);
}

void ProgressReporter::Advance(std::int64_t count) {
  done_.fetch_add(count, std::memory_order_relaxed);
  if (listener_) listener_();
  if (mode_ == Mode::Quiet) return;
  // If another thread is drawing, this thread continues its work instead of waiting.
  const std::unique_lock lock(mutex_, std::try_to_lock);
  if (lock) Draw(false);
}

void ProgressReporter::SetDone(std::int64_t done) {
  done_ = done;
  Advance(0);
}

void ProgressReporter::End() {
  const std::lock_guard lock(mutex_);
  if (phase_.empty()) return;
  Draw(true);
  phase_.clear();
}

// The caller holds the mutex. `final` means that the phase has ended, at any count.
void ProgressReporter::Draw(bool final) {
  if (mode_ == Mode::Quiet || phase_.empty()) return;
  const std::int64_t done = std::clamp<std::int64_t>(done_, 0, total_);
  const double fraction = double(done) / double(total_), elapsed = SecondsSince(start_);
  const int tenth = int(fraction * 10);
  const auto sinceDraw = Clock::now() - lastDraw_;
  const bool isDue = isTerminal_ ? done == 0 || sinceDraw >= kRedrawInterval
                                 : tenth > lastTenth_ || sinceDraw >= kLineInterval;
  if (!final && (!isDue || done == total_)) return;
  lastTenth_ = tenth;
  lastDraw_ = Clock::now();

  char percent[16];
  std::snprintf(percent, sizeof percent, "%3d %%", int(fraction * 100));
  std::string times = DurationText(elapsed) + " elapsed";
  if (!final && done > 0) {
    times += ", " + DurationText(elapsed * (1 - fraction) / fraction) + " left";
  }
  if (!isTerminal_) {
    Write(phase_ + ": " + percent + ", " + times + "\n");
    return;
  }
  const int taken = int(phase_.size() + times.size()) + 14;
  const int width = std::clamp(TerminalColumns() - taken, 0, 40);
  const int filled = int(fraction * width);
  Write("\r\x1b[K" + phase_ + ": [" + std::string(std::size_t(filled), '=') +
        std::string(std::size_t(width - filled), ' ') + "] " + percent + " " + times +
        (final ? "\n" : ""));
}

}  // namespace exphoton
