// SPDX-License-Identifier: BSD-2-Clause
#include "core/render/passes/progress/pass_progress.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/format.h"
#include "core/render/passes/accuracy/accuracy_rule.h"

namespace exphoton {
namespace {

constexpr std::int64_t kSteps = 1'000'000;  // of the bar
constexpr double kUpdateSeconds = .05;
constexpr double kLeastShare = .02;  // of a pass, which shows its speed
// With shared gathers, the noise part of relMSE is about kNoise rays^-kRaySlope for one sample a
// pixel, if a sample traces that number of rays and the picture has kPixels pixels. Fitted to the
// scenes of this project; half of them are within a factor of 2.
constexpr double kNoise = .18, kRaySlope = .6, kSampleSlope = 1.2;
constexpr double kPixels = 200 * 150, kPixelSlope = .2;
constexpr double kLeastPreparation = .1;  // of the first phase, for an estimate

double Seconds(std::chrono::steady_clock::duration time) {
  return std::chrono::duration<double>(time).count();
}

std::string NoiseText(double noise, const std::optional<double>& target) {
  if (target) return Format("noise %.2g of relMSE (target %.3g)", noise, *target);
  return "noise \u00b1" + Plain(100 * std::sqrt(noise), 2) + " %";
}

}  // namespace

void TimeForecast::Begin(const PassPlan& plan, const PassPlan::Step& step,
                         const PassPlan::State& state) {
  after_ = plan;
  after_->Take(step);
  step_ = step;
  before_ = state;
}

std::optional<TimeForecast::Estimate> TimeForecast::Left(const Pass& pass) const {
  if (!after_) return std::nullopt;
  const double limit = rule_.timeLimit
                           ? std::max(*rule_.timeLimit - before_.elapsed - pass.seconds, 0.)
                           : std::numeric_limits<double>::infinity();
  const bool isMeasured = pass.part.isRendering && pass.part.ofPhase >= kLeastShare;
  if (!isMeasured && before_.samples == 0) return LeftWhilePreparing(pass, limit);
  // The speed of earlier passes counts less and less.
  const double expected = before_.sample * double(step_.size);
  const double done = isMeasured ? pass.part.ofPhase : 0;
  double passSeconds = expected;
  if (isMeasured) {
    const double measured = pass.part.phaseSeconds / done;
    passSeconds = before_.samples == 0 ? measured : done * measured + (1 - done) * expected;
  }
  PassPlan::State state = before_;
  state.samples += step_.size;
  state.sample = (pass.renderSeconds + passSeconds) / double(state.samples);
  double rest = std::max(passSeconds - (pass.part.isRendering ? pass.part.phaseSeconds : 0), 0.);
  if (pass.part.isRendering && step_.isNewGroup && !state.keepsPhotons)
    state.preprocess = std::max({state.preprocess, pass.seconds - pass.part.phaseSeconds,
                                 scene_.photonSamples * state.sample});
  else if (!pass.part.isRendering && step_.isNewGroup)
    rest += std::max(state.preprocess - pass.seconds, 0.);
  state.elapsed += pass.seconds + rest;
  const auto after = LeftAfter(state, pass.rays);
  if (after) return Estimate{std::min(rest + after->left, limit), after->isRough};
  return rule_.timeLimit ? std::optional(Estimate{limit, false}) : std::nullopt;
}

// The first photons show how long samples take, if their price is known. Otherwise preparation
// takes a fifth of the time, as in the bar of a render of one pass.
std::optional<TimeForecast::Estimate> TimeForecast::LeftWhilePreparing(const Pass& pass,
                                                                       double limit) const {
  const double done = pass.part.done;
  const bool hasBegun = pass.part.ofPhase >= kLeastPreparation || done > .1;
  if (!hasBegun || pass.part.isRendering)
    return rule_.timeLimit ? std::optional(Estimate{limit, false}) : std::nullopt;
  double left = pass.seconds * (1 - done) / done;
  if (scene_.photonSamples > 0) {
    PassPlan::State state = before_;
    state.samples += step_.size;
    state.preprocess = pass.seconds * ProgressReporter::kPreparationShare / done;
    state.sample = state.preprocess / scene_.photonSamples;
    const double ofPass = state.sample * double(step_.size);
    if (const auto after = LeftAfter(state, 0))
      left = std::max(state.preprocess - pass.seconds, 0.) + ofPass + after->left;
  }
  return Estimate{std::min(left, limit), left < limit};
}

// Returns the time that passes after the current one will take. `rays`: as in Pass.
std::optional<TimeForecast::Estimate> TimeForecast::LeftAfter(PassPlan::State state,
                                                              double rays) const {
  // The first look at the error is after two groups. Before it, only the pilots know.
  if (rule_.accuracy && before_.samples < 2 * rule_.accuracy->firstSamples)
    state.needed = std::max(state.needed.value_or(0), rule_.accuracy->expectedSamples);
  // The noise has been estimated before the current pass, which lowers it.
  if (state.noise) *state.noise *= double(before_.samples) / double(state.samples);
  const bool isQuietEnough = rule_.targetError && state.noise && *state.noise <= *rule_.targetError;
  const bool isAccurate = rule_.accuracy && double(state.samples) >=
                                                std::max(state.needed.value_or(0),
                                                         2. * double(rule_.accuracy->firstSamples));
  if (isQuietEnough || isAccurate) return Estimate{};
  bool isRough = false;
  if (rule_.targetError && !state.enough && scene_.sharesGathers && rays > 0) {
    const double noise = kNoise * std::pow(rays, -kRaySlope) *
                         std::pow(kPixels / double(scene_.pixels), kPixelSlope);
    state.enough = std::pow(noise / *rule_.targetError, 1 / kSampleSlope);
    isRough = true;
  }
  // All passes of this kind shoot photons.
  if (rule_.passSamples > 0) state.sample += state.preprocess / double(rule_.passSamples);
  const auto left = after_->SecondsLeft(state);
  return left ? std::optional(Estimate{*left, isRough}) : std::nullopt;
}

PassProgress::PassProgress(ProgressReporter* shown, const StoppingRule& rule,
                           const TimeForecast::Scene& scene)
    : shown_(shown),
      rule_(rule),
      quiet_(ProgressReporter::Mode::Quiet),
      forecast_(rule, scene),
      pixels_(double(scene.pixels)) {
  quiet_.SetListener([this] { Update(); });
}

void PassProgress::Begin() {
  begin_ = Clock::now();
  shown_->Begin("Rendering", kSteps);
}

void PassProgress::BeginPass(const PassPlan& plan, const PassPlan::Step& step,
                             const PassPlan::State& state, double renderSeconds) {
  const std::lock_guard lock(mutex_);
  forecast_.Begin(plan, step, state);
  passBegin_ = Clock::now();
  renderSeconds_ = renderSeconds;
  samples_ = double(step.size);
  rays_ = 0;
}

void PassProgress::Update() {
  if (shown_->IsQuiet()) return;
  const std::uint64_t rays = quiet_.TakeRays();
  shown_->CountRays(rays);
  rays_ += rays;
  // If another thread updates, this thread continues its work instead of waiting.
  const std::unique_lock lock(mutex_, std::try_to_lock);
  if (!lock) return;
  const Clock::time_point now = Clock::now();
  if (Seconds(now - lastUpdate_) < kUpdateSeconds) return;
  lastUpdate_ = now;
  const auto estimate = forecast_.Left(CurrentPass(now));
  if (!estimate) return shown_->Advance(0);
  shown_->SetRough(estimate->isRough);
  const double elapsed = Seconds(now - begin_), expected = elapsed + estimate->left;
  shown_->SetDone(std::int64_t(double(kSteps) * std::min(elapsed / expected, .99)));
}

TimeForecast::Pass PassProgress::CurrentPass(Clock::time_point now) {
  TimeForecast::Pass pass{quiet_.Done(), Seconds(now - passBegin_), renderSeconds_};
  if (!pass.part.isRendering) rays_ = 0;  // these were photons'
  const double samples = pass.part.ofPhase * pixels_ * samples_;
  if (pass.part.isRendering && samples > 0) pass.rays = double(rays_) / samples;
  return pass;
}

void PassProgress::ShowPasses(const PassSum& sum, const AccuracyRule* accuracy) {
  if (shown_->IsQuiet()) return;
  const auto samples = static_cast<long long>(sum.SamplesPerPixel());
  std::vector<std::string> details{
      Format("%lld sample%s a pixel", samples, samples == 1 ? "" : "s")};
  if (rule_.passSamples > 0 && rule_.maxSamples < StoppingRule::kMaxSamples)
    details = {Format("%d of %lld passes", sum.Passes(),
                      static_cast<long long>(rule_.maxSamples / rule_.passSamples))};
  else if (rule_.passSamples > 0)
    details = {Format("%d passes", sum.Passes())};
  if (accuracy && std::isfinite(accuracy->Upper()) && accuracy->Upper() > 0)
    details.push_back("error below " + Plain(100 * std::sqrt(accuracy->Upper()), 2) + " %");
  if (const auto noise = sum.Noise(); noise && std::isfinite(*noise))
    details.push_back(NoiseText(*noise, rule_.targetError));
  shown_->SetDetails(std::move(details));
}

void PassProgress::End(bool isWhole) {
  if (isWhole) shown_->SetDone(kSteps);
  shown_->End();
}

}  // namespace exphoton
