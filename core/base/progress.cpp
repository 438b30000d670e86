// SPDX-License-Identifier: BSD-2-Clause
// ProgressReporter draws the progress bar. The time left assumes that the rest of the last phase
// runs at the average speed of this phase so far.
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
constexpr double kPhaseShare = .7;  // of the rest of the preparation, for a phase of it
constexpr double kLeastPreparation = .1 * kPhaseShare;  // of the preparation, for an estimate
constexpr int kLeastBar = 10;  // columns of a bar beside which details have room

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

std::string LeftText(std::optional<double> left, bool isRough) {
  if (!left) return "";
  return (isRough ? ", about " : ", ") + DurationText(*left) + " left";
}

// Returns each text after a comma and a blank, without empty texts.
std::string Joined(const std::vector<std::string>& texts) {
  std::string joined;
  for (const std::string& text : texts)
    if (!text.empty()) joined += ", " + text;
  return joined;
}

void Write(const std::string& text) {
  std::fwrite(text.data(), 1, text.size(), stderr);
  std::fflush(stderr);
}

}  // namespace

ProgressReporter::ProgressReporter(Mode mode, Seconds clock)
    : mode_(mode), clock_(clock ? std::move(clock) : SteadySeconds), isTerminal_(IsRedrawable()) {}

void ProgressReporter::BeginPicture(int index, int count) {
  const std::lock_guard lock(mutex_);
  picture_ = index, pictureCount_ = count;
  hasBegun_ = false;
}

void ProgressReporter::Begin(std::string phase, std::int64_t total) {
  const std::lock_guard lock(mutex_);
  // The first phase, which shoots photons, usually takes the most time before the last.
  phaseFrom_ = hasBegun_ ? std::min(phaseTo_, kPreparationShare) : 0;
  phaseTo_ = phase == kLastPhase ? 1 : phaseFrom_ + kPhaseShare * (kPreparationShare - phaseFrom_);
  phase_ = std::move(phase);
  total_ = std::max<std::int64_t>(total, 1);
  done_ = 0;
  rays_ = 0;
  phaseStart_ = clock_();
  if (!hasBegun_) pictureStart_ = phaseStart_;
  if (!start_) start_ = phaseStart_;
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

void ProgressReporter::SetDetails(std::vector<std::string> details) {
  const std::lock_guard lock(mutex_);
  details_ = std::move(details);
}

ProgressReporter::Part ProgressReporter::Done() const {
  const std::lock_guard lock(mutex_);
  return DoneAt(clock_());
}

void ProgressReporter::End() {
  const std::lock_guard lock(mutex_);
  if (phase_.empty()) return;
  if (mode_ != Mode::Quiet && isTerminal_) {
    const double seconds = clock_() - phaseStart_;
    std::string text = "\r\x1b[K";
    if (seconds >= kShortPhaseSeconds)
      text += phase_ + ": " + DurationText(seconds) + Joined({Rate()}) + '\n';
    Write(text);
  }
  phase_.clear();
  details_.clear();
}

// The caller holds the mutex, here and below.
ProgressReporter::Part ProgressReporter::DoneAt(double now) const {
  const double part = double(std::clamp<std::int64_t>(done_, 0, total_)) / double(total_);
  return {phaseFrom_ + (phaseTo_ - phaseFrom_) * part, part, now - phaseStart_,
          phase_ == kLastPhase};
}

ProgressReporter::Moment ProgressReporter::Now() const {
  const double now = clock_();
  const Part part = DoneAt(now);
  const double inPicture = now - pictureStart_;
  Moment moment{
      (picture_ + part.done) / pictureCount_, now - *start_, {}, isRough_ || !part.isRendering};
  if (part.isRendering && part.ofPhase > 0)
    moment.left = part.phaseSeconds * (1 - part.ofPhase) / part.ofPhase;
  else if (!part.isRendering && part.done >= kLeastPreparation * kPreparationShare)
    moment.left = inPicture * (1 - part.done) / part.done;
  const int laterPictures = pictureCount_ - picture_ - 1;
  if (moment.left) *moment.left += laterPictures * (inPicture + *moment.left);
  return moment;
}

std::string ProgressReporter::Rate() const {
  const double seconds = clock_() - phaseStart_, rays = double(rays_);
  if (rays == 0 || seconds <= 0) return "";
  const double rate = rays / seconds;
  return rate >= 1e6 ? Format("%.1f M rays/s", rate / 1e6) : Format("%.0f k rays/s", rate / 1e3);
}

std::vector<std::string> ProgressReporter::Extras() const {
  std::vector<std::string> extras = details_;
  extras.push_back(Rate());
  std::erase(extras, "");
  return extras;
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
  // A character in the last column would make some terminals begin another line.
  const int columns = TerminalColumns() - 1;
  const std::string percent = Format("%3d %%", int(now.fraction * 100));
  const std::string times = ' ' + DurationText(now.elapsed) + LeftText(now.left, now.isRough);
  const int taken = Characters(phase_ + ": [] " + percent + times);
  std::vector<std::string> extras = Extras();
  while (!extras.empty() && taken + Characters(Joined(extras)) + kLeastBar > columns)
    extras.pop_back();
  const std::string extra = Joined(extras);
  const int width = std::min(columns - taken - Characters(extra), 40);
  std::string text;
  if (width > 0) {
    const auto filled = std::size_t(now.fraction * width);
    text = phase_ + ": [" + std::string(filled, '=') +
           std::string(std::size_t(width) - filled, ' ') + "] " + percent + times + extra;
  } else {
    text = phase_ + ": " + percent + times;
    if (Characters(text) > columns) text = percent + times;
    if (Characters(text) > columns) text = percent;
  }
  Write("\r\x1b[K" + text);
}

void ProgressReporter::PrintLine(const Moment& now) const {
  Write(phase_ + Format(": %3d %%, ", int(now.fraction * 100)) + DurationText(now.elapsed) +
        " elapsed" + LeftText(now.left, now.isRough) + Joined(Extras()) + '\n');
}

}  // namespace exphoton
