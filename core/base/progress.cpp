// SPDX-License-Identifier: BSD-2-Clause
// ProgressReporter draws the progress bar. The remaining time assumes that the rest of the last
// phase runs at the average speed of this phase so far.
#include "core/base/progress.h"

#include <algorithm>
#include <cstdio>
#include <utility>

#include "core/base/format.h"
#include "core/base/terminal.h"

namespace exphoton {
namespace {

constexpr double kRedrawSeconds = .1;
constexpr double kFirstLineSeconds = 5, kLineSeconds = 10;
constexpr double kShortPhaseSeconds = 1;
constexpr const char* kLastPhase = "Rendering";
constexpr double kPreparationShare = .2;  // of the bar, for all phases before the last

double SteadySeconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

// Formats a duration as "7.3 s", "2 min 05 s" or "3 h 20 min".
std::string DurationText(double seconds) {
  const auto whole = static_cast<long long>(std::min(seconds, 1e12));
  if (seconds < 60) return Format("%.1f s", seconds);
  if (whole < 3600) return Format("%lld min %02lld s", whole / 60, whole % 60);
  return Format("%lld h %02lld min", whole / 3600, whole / 60 % 60);
}

void Write(const std::string& text) {
  std::fwrite(text.data(), 1, text.size(), stderr);
  std::fflush(stderr);
}

}  // namespace

ProgressReporter::ProgressReporter(Mode mode, Seconds clock)
    : mode_(mode), clock_(clock ? std::move(clock) : SteadySeconds), isTerminal_(IsRedrawable()) {}

void ProgressReporter::Begin(std::string phase, std::int64_t total) {
  const std::lock_guard lock(mutex_);
  // A phase before the last takes half of what is left of the first fifth.
  phaseFrom_ = hasBegun_ ? std::min(phaseTo_, kPreparationShare) : 0;
  phaseTo_ = phase == kLastPhase ? 1 : (phaseFrom_ + kPreparationShare) / 2;
  phase_ = std::move(phase);
  total_ = std::max<std::int64_t>(total, 1);
  done_ = 0;
  rays_ = 0;
  phaseStart_ = clock_();
  if (!hasBegun_) start_ = phaseStart_;
  hasBegun_ = true;
}

void ProgressReporter::Advance(std::int64_t count) {
  done_.fetch_add(count, std::memory_order_relaxed);
  if (listener_) listener_();
  if (mode_ == Mode::Quiet) return;
  // If another thread is drawing, this thread continues its work instead of waiting.
  const std::unique_lock lock(mutex_, std::try_to_lock);
  if (lock) Draw();
}

void ProgressReporter::SetDone(std::int64_t done) {
  done_ = done;
  Advance(0);
}

void ProgressReporter::SetDetail(std::string detail) {
  const std::lock_guard lock(mutex_);
  detail_ = std::move(detail);
}

void ProgressReporter::End() {
  const std::lock_guard lock(mutex_);
  if (phase_.empty()) return;
  if (mode_ != Mode::Quiet && isTerminal_) {
    const double seconds = clock_() - phaseStart_;
    std::string text = "\r\x1b[K";
    if (seconds >= kShortPhaseSeconds)
      text += phase_ + ": " + DurationText(seconds) + Rate() + '\n';
    Write(text);
  }
  phase_.clear();
  detail_.clear();
}

// The caller holds the mutex, here and below.
ProgressReporter::Moment ProgressReporter::Now() const {
  const double now = clock_();
  const double part = double(std::clamp<std::int64_t>(done_, 0, total_)) / double(total_);
  Moment moment{phaseFrom_ + (phaseTo_ - phaseFrom_) * part, now - start_, {}};
  if (phase_ == kLastPhase && part > 0) moment.left = (now - phaseStart_) * (1 - part) / part;
  return moment;
}

std::string ProgressReporter::Rate() const {
  const double seconds = clock_() - phaseStart_, rays = double(rays_);
  if (rays == 0 || seconds <= 0) return "";
  const double rate = rays / seconds;
  if (rate >= 1e6) return Format(", %.1f M rays/s", rate / 1e6);
  return Format(", %.0f k rays/s", rate / 1e3);
}

bool ProgressReporter::IsLineDue(const Moment& now) {
  const bool isFirst = lastDraw_ == 0;
  if (now.elapsed < (isFirst ? kFirstLineSeconds : lastDraw_ + kLineSeconds)) return false;
  const int tenth = int(now.fraction * 10);
  if (!isFirst && tenth <= lastTenth_) return false;
  lastTenth_ = tenth;
  return true;
}

void ProgressReporter::Draw() {
  if (mode_ == Mode::Quiet || phase_.empty() || done_ >= total_) return;
  const Moment now = Now();
  // A phase shorter than the interval is never drawn.
  const bool isDue = isTerminal_ ? now.elapsed >= lastDraw_ + kRedrawSeconds : IsLineDue(now);
  if (!isDue) return;
  lastDraw_ = now.elapsed;
  if (isTerminal_)
    DrawBar(now);
  else
    PrintLine(now);
}

void ProgressReporter::DrawBar(const Moment& now) const {
  std::string times = DurationText(now.elapsed);
  if (now.left) times += ", " + DurationText(*now.left) + " left";
  const int columns = TerminalColumns();
  std::string extra = Rate() + (detail_.empty() ? "" : ", " + detail_);
  const int taken = int(phase_.size() + times.size()) + 14;
  // The extra figures appear only where a bar of ten columns stays beside them.
  if (taken + int(extra.size()) + 10 > columns) extra.clear();
  const int width = std::clamp(columns - taken - int(extra.size()), 0, 40);
  const int filled = int(now.fraction * width);
  const std::string bar =
      std::string(std::size_t(filled), '=') + std::string(std::size_t(width - filled), ' ');
  Write("\r\x1b[K" + phase_ + ": [" + bar + Format("] %3d %% ", int(now.fraction * 100)) + times +
        extra);
}

void ProgressReporter::PrintLine(const Moment& now) const {
  std::string text = phase_ + Format(": %3d %%, ", int(now.fraction * 100));
  text += DurationText(now.elapsed) + " elapsed";
  if (now.left) text += ", " + DurationText(*now.left) + " left";
  Write(text + Rate() + (detail_.empty() ? "" : ", " + detail_) + '\n');
}

}  // namespace exphoton
