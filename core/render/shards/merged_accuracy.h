// SPDX-License-Identifier: BSD-2-Clause
// MergedAccuracy decides how many passes of parts belong to a picture for an accuracy
// (--accuracy). It looks at the error as a render of the same passes on one machine does.
#pragma once

#include <optional>

#include "core/render/certificate/corrections.h"
#include "core/render/passes/accuracy/accuracy_rule.h"
#include "core/render/passes/pass_sum.h"
#include "core/render/render_totals.h"
#include "core/render/shards/picture_passes.h"

namespace exphoton {

class MergedAccuracy {
 public:
  // corrections: receives those of the passes; null: the integrator has no bias.
  MergedAccuracy(const PicturePasses::Accuracy& accuracy, Corrections* corrections)
      : rule_(accuracy.error, accuracy.biasShare, accuracy.omitted), corrections_(corrections) {}

  Corrections* OfPass() { return corrections_; }
  // Must be called after the last pass was added to the sum, and what it shows about the bias of
  // shared gathers to the totals.
  void EndPass(const PassSum& sum, const RenderTotals& totals, std::int64_t samplesPerPixel,
               Log& log);
  // Returns why no later pass belongs to the picture; nullopt: the passes so far do not decide it.
  std::optional<StopReason> Reason() const;
  void Describe(const PassSum& sum, PassesResult* result) const;

 private:
  AccuracyRule rule_;
  Corrections* corrections_;
};

}  // namespace exphoton
