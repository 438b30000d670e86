// SPDX-License-Identifier: BSD-2-Clause
#include "core/render/passes/pass_sum.h"

#include <algorithm>
#include <cmath>

#include "core/files/byte_archive.h"

namespace exphoton {

const char* StopReasonName(StopReason reason) {
  switch (reason) {
    case StopReason::Samples:
      return "samples";
    case StopReason::TargetError:
      return "target-error";
    case StopReason::Accuracy:
      return "accuracy";
    case StopReason::Bias:
      return "bias";
    case StopReason::TimeLimit:
      return "time-limit";
    case StopReason::Signal:
      return "signal";
  }
  return "";
}

void PassSum::Add(const Film& pass, std::int64_t samplesPerPixel, int group) {
  picture_->Add(pass);
  noise_.Add(group % kPlaces, pass, samplesPerPixel);
  known_.reset();
  ++passes_;
  groups_ = std::max(groups_, group + 1);
  samples_ += samplesPerPixel;
}

std::optional<double> PassSum::Noise() const {
  if (groups_ > 1 && !known_) known_ = correction_ * noise_.RelativeVariance();
  return known_;
}

double PassSum::NoiseError() const { return correction_ * noise_.RelativeVarianceError(); }

// Let the error of n samples of a sequence be n^-s, and q = 2^-s. The difference of two successive
// halves of n samples each suggests the error 1 - q for their mean, whose error is q. The same
// holds within each half, where all errors are larger by 1 / q. So the ratio of the differences is
// q, and the noise is the difference times q / (1 - q). The noise of photons shows between groups
// only. It raises the ratio, so the noise is overestimated then. Independent samples have the ratio
// 1/2. A rough ratio may be too small, and the noise then lies between that for the ratio and that
// for 1/2. The geometric mean of both is wrong by a factor of 1.36 at most.
void PassSum::CorrectForSequence(double within, bool isRough) {
  constexpr double kLeastRatio = .35;
  correction_ = 1;
  if (groups_ > 1 && within > 0) {
    const double q = std::clamp(noise_.RelativeVariance() / within, kLeastRatio, .5);
    correction_ = isRough ? std::sqrt(q / (1 - q)) : q / (1 - q);
  }
  known_.reset();
}

std::optional<StopReason> PassSum::Reason() const {
  if (limits_.targetError && groups_ > 1 && *Noise() <= *limits_.targetError)
    return StopReason::TargetError;
  if (samples_ >= limits_.maxSamples) return StopReason::Samples;
  return std::nullopt;
}

void PassSum::Describe(bool needsVariances, PassesResult* result) const {
  result->passes = passes_;
  result->samplesPerPixel = samples_;
  result->noise = Noise();
  result->noiseError = result->noise ? NoiseError() : 0;
  if (!needsVariances || groups_ < 2) return;
  result->variances = noise_.Variances();
  for (float& variance : result->variances) variance *= float(correction_);
}

void PassSum::TransferCounts(ByteArchive* archive) {
  archive->Values(&passes_, &groups_, &samples_, &correction_);
  if (groups_ < 0 || groups_ > passes_ || samples_ < 0 || samples_ > limits_.maxSamples ||
      !(correction_ > 0 && correction_ <= 1))
    throw ArchiveError("its counts of passes contradict each other");
  known_.reset();
}

}  // namespace exphoton
