// SPDX-License-Identifier: BSD-2-Clause
#include "core/render/shards/merged_accuracy.h"

#include "core/render/passes/accuracy/accuracy_look.h"

namespace exphoton {

void MergedAccuracy::EndPass(const PassSum& sum, const RenderTotals& totals,
                             std::int64_t samplesPerPixel, Log& log) {
  if (corrections_) corrections_->EndPass(sum.Groups() - 1, samplesPerPixel);
  if (!sum.Noise()) return;
  LookAtError({sum, corrections_, totals.MeanSharingBias()}, &rule_, log);
}

std::optional<StopReason> MergedAccuracy::Reason() const {
  if (rule_.IsReached()) return StopReason::Accuracy;
  if (rule_.IsOutOfReach()) return StopReason::Bias;
  return std::nullopt;
}

void MergedAccuracy::Describe(const PassSum& sum, PassesResult* result) const {
  result->looks = rule_.Looks();
  if (rule_.HasLooked()) result->upperError = rule_.Upper();
  if (corrections_ && sum.Groups() > 1) result->levels = sum.Levels();
}

}  // namespace exphoton
