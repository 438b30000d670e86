// SPDX-License-Identifier: BSD-2-Clause
// PassPlan: without a time limit, all decisions follow from pixel values.
#include "core/render/passes/pass_plan.h"

#include <algorithm>
#include <cmath>

#include "core/files/byte_archive.h"
#include "core/render/passes/cancelling_errors.h"

namespace exphoton {
namespace {

constexpr double kMaxGroupsInTime = 8;
constexpr double kPreprocessShare = .1;  // of a time limit, where it allows two groups
constexpr double kRounding = 1.5;        // sizes are rounded up from above 2^k / 1.5
constexpr double kWellShared = 8;        // samples of a group whose gathers are shared well
constexpr double kFewestShared = 4;      // with fewer samples, they are shared much worse
constexpr double kHuge = 0x1p50;
constexpr double kDearPhotons = .25;  // of the price of the samples of a pass

// Low-discrepancy sequences are best distributed where their length is a power of two, so all
// groups have such sizes. Returns the largest power of two up to the number, at least 1.
std::int64_t PowerOfTwoUpTo(double samples) {
  return std::int64_t(std::exp2(std::floor(std::log2(std::clamp(samples, 1., kHuge)))));
}

// Samples m 2^k to (m + 1) 2^k of a low-discrepancy sequence are well distributed. Returns the
// largest 2^k for which samples that begin at this number are such a range.
std::int64_t LargestPowerOfTwoIn(std::int64_t samples) {
  return std::max<std::int64_t>(samples & -samples, 1);
}

}  // namespace

void GroupForecast::Add(const Film& pass, std::int64_t samplesPerPixel) {
  if (!noise_) return;
  noise_->Add(samples_ == 0 ? 0 : 1, pass, samplesPerPixel);
  const std::int64_t before = samples_;
  samples_ += samplesPerPixel;
  if (before == 0) return;
  const double difference = noise_->RelativeVariance();
  if (difference_ > 0 && difference > 0) {
    const double octaves = std::log2(double(samples_) / double(before));
    slope_ = std::clamp(std::log2(difference_ / difference) / octaves, 1., 2.);
  }
  levels_ = difference_ > 0 ? std::vector<double>() : noise_->Levels();
  difference_ = difference;
  noise_->Join();
}

std::optional<double> GroupForecast::SamplesFor(double noise) const {
  if (!(difference_ > 0)) return std::nullopt;
  const double q = std::exp2(-slope_);
  const double error = difference_ * CancellingErrors(q, TrustIn(samples_, sharesGathers_));
  return double(samples_) * std::pow(error / noise, 1 / slope_);
}

void GroupForecast::Transfer(ByteArchive* archive) {
  char hasNoise = noise_ ? 1 : 0;
  archive->Values(&hasNoise, &samples_, &difference_, &slope_);
  if (!hasNoise) noise_.reset();
  if (noise_) noise_->Transfer(archive);
}

void PassPlan::Transfer(ByteArchive* archive) {
  archive->Values(&groups_, &groupSamples_, &firstSamples_);
  const bool isPossible = groups_ >= 0 && groupSamples_ >= 0 && double(groupSamples_) <= kHuge &&
                          firstSamples_ >= 0 && double(firstSamples_) <= kHuge;
  if (!isPossible) throw ArchiveError("its groups of passes are impossible");
}

// Returns the samples of a group, if all groups share the time equally.
std::int64_t PassPlan::GoalByTime(const State& state) const {
  if (!limits_.timeLimit || state.samples == 0) return std::int64_t(kHuge);
  const double time = *limits_.timeLimit;
  const double share = kPreprocessShare * time / std::max(state.preprocess, 1e-9);
  const double groups = std::floor(std::clamp(share, 2., kMaxGroupsInTime));
  const double spent = double(state.samples) * state.sample + groups_ * state.preprocess;
  const double before = std::max(state.elapsed - spent, 0.);  // reading the scene
  const double each = (time - before) / groups - state.preprocess;
  return PowerOfTwoUpTo(each / std::max(state.sample, 1e-9));
}

std::int64_t PassPlan::FirstGoal(const State& state) const {
  const std::int64_t most =
      std::min(PowerOfTwoUpTo(double(limits_.maxSamples + 1) / 2), GoalByTime(state));
  if (!limits_.targetError) return most;
  if (!state.enough) return std::min<std::int64_t>(2, most);
  return std::min(PowerOfTwoUpTo(kRounding * *state.enough / 2), most);
}

// The second group is as large as the first one. If groups have photons of their own, the noise may
// then come from photons, which larger groups would not reduce.
std::int64_t PassPlan::LaterGoal(const State& state) const {
  const std::int64_t most = GoalByTime(state);
  if (!limits_.targetError) return most;
  if (groups_ < 2 || !state.noise) return std::min(PowerOfTwoUpTo(double(firstSamples_)), most);
  const double samples = double(state.samples);
  const double missing = samples * (*state.noise / *limits_.targetError - 1);
  // A small group may have to shoot photons, and its gathers are shared less well.
  const double fewest = limits_.sharesGathers ? std::min(kFewestShared, samples) : 1;
  const double least = std::max({samples / 8, std::min(samples / 2, kWellShared), fewest});
  const double largest = limits_.sharesGathers ? samples : std::max(samples / 2, least);
  const double size = std::clamp(missing * kRounding, least, largest);
  return std::min(PowerOfTwoUpTo(size), most);
}

PassPlan::Step PassPlan::NextForAccuracy(const State& state) const {
  std::int64_t size = limits_.firstSamples;
  // Each look at the picture costs confidence, and small passes say little about the bias of shared
  // gathers, so passes are not small.
  const double least = std::max(double(state.samples) / 4, double(limits_.firstSamples));
  if (groups_ > 1) {
    const double missing = state.needed.value_or(0) - double(state.samples);
    size = PowerOfTwoUpTo(std::clamp(missing * kRounding, least, double(state.samples)));
    size = std::min(size, std::max(LargestPowerOfTwoIn(state.samples), limits_.firstSamples));
  }
  size = std::max<std::int64_t>(std::min(size, limits_.maxSamples - state.samples), 1);
  if (limits_.timeLimit && state.samples > 0) {
    const double left = *limits_.timeLimit - state.elapsed - state.preprocess;
    const double fits = std::floor(left / std::max(state.sample, 1e-9));
    if (fits < double(size)) size = fits < 1 ? 0 : PowerOfTwoUpTo(fits);
  }
  const bool hasDearPhotons =
      !state.keepsPhotons && limits_.photonSamples > kDearPhotons * double(size);
  const std::int64_t most = 2 * firstSamples_ - groupSamples_;
  // Where photons must be shot anew for each group, a pass that is large enough goes into the last
  // one. Otherwise passes would stay as small as the first ones, however many samples are needed.
  const bool fitsLastGroup = double(most) >= std::min(double(size), least);
  if (!hasDearPhotons || groups_ < 2 || most < 1 || !fitsLastGroup) return {true, size};
  return {false, std::min(size, most)};
}

PassPlan::Step PassPlan::Next(const State& state) const {
  if (limits_.firstSamples > 0) return NextForAccuracy(state);
  if (limits_.passSamples > 0) {
    const double needed = state.preprocess + double(limits_.passSamples) * state.sample;
    const bool fits =
        !limits_.timeLimit || state.samples == 0 || state.elapsed + needed <= *limits_.timeLimit;
    return {true, fits ? limits_.passSamples : 0};
  }
  Step step;
  std::int64_t goal = 1;
  if (groups_ > 0) {
    goal = groups_ == 1 ? FirstGoal(state) : GoalByTime(state);
    if (groups_ == 2 && limits_.targetError) goal = std::min(goal, firstSamples_);
    step.isNewGroup = groupSamples_ >= goal || (groups_ > 2 && limits_.targetError);
    if (step.isNewGroup) goal = LaterGoal(state);
  }
  step.size = step.isNewGroup ? goal : goal - groupSamples_;
  if (groups_ == 1) {
    const std::int64_t half = step.isNewGroup ? std::max<std::int64_t>(goal / 2, 1) : groupSamples_;
    step.size = std::min(step.size, half);
  }
  step.size = std::max<std::int64_t>(std::min(step.size, limits_.maxSamples - state.samples), 1);
  if (limits_.timeLimit && state.samples > 0) {
    const double left =
        *limits_.timeLimit - state.elapsed - (step.isNewGroup ? state.preprocess : 0);
    const double fits = std::floor(left / std::max(state.sample, 1e-9));
    if (fits < double(step.size)) step.size = fits < 1 ? 0 : PowerOfTwoUpTo(fits);
    // Small groups at the end would spend the time on preprocessing.
    const bool isSmall = double(step.size) * state.sample < 2 * state.preprocess;
    if (groups_ > 1 && step.isNewGroup && isSmall) step.size = 0;
  }
  return step;
}

void PassPlan::Take(const Step& step) {
  if (step.isNewGroup) ++groups_, groupSamples_ = 0;
  groupSamples_ += step.size;
  if (groups_ == 1) firstSamples_ = groupSamples_;
}

std::optional<double> PassPlan::SecondsLeft(const State& state) const {
  if (state.samples == 0) {
    if (!limits_.timeLimit) return std::nullopt;
    return std::max(*limits_.timeLimit - state.elapsed, 0.);
  }
  double seconds = double(limits_.maxSamples - state.samples) * state.sample;
  bool isKnown = double(limits_.maxSamples) < kHuge;
  if (limits_.firstSamples > 0) {
    const double goal = std::max(state.needed.value_or(0), 2. * double(limits_.firstSamples));
    const double missing = std::max(goal - double(state.samples), 0.);
    seconds = std::min(seconds, missing * state.sample + state.preprocess);
  }
  if (limits_.targetError) {
    isKnown = groups_ > 1 || state.enough;
    const Step step = Next(state);
    double goal = double(state.samples + step.size);
    if (groups_ == 1) goal = 2 * double(FirstGoal(state));
    if (groups_ == 2 && !step.isNewGroup) goal = 2 * double(firstSamples_);
    const bool isNewGroup = groups_ == 1 || step.isNewGroup;
    const double needed = std::max(goal - double(state.samples), 0.) * state.sample +
                          (isNewGroup ? state.preprocess : 0);
    seconds = std::min(seconds, needed);
  }
  if (limits_.timeLimit) {
    const double left = std::max(*limits_.timeLimit - state.elapsed, 0.);
    seconds = isKnown ? std::min(seconds, left) : left;
    isKnown = true;
  }
  return isKnown ? std::optional(seconds) : std::nullopt;
}

}  // namespace exphoton
