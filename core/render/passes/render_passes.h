// SPDX-License-Identifier: BSD-2-Clause
// RenderInPasses renders the picture as the mean of independent passes until a stopping rule holds.
// Each pass has separate camera samples. Groups of passes may have separate preprocessing (photon
// maps). Derivation and measurements: docs/decisions/0007-stopping-rules.md.
#pragma once

#include <chrono>
#include <limits>
#include <optional>

#include "core/render/passes/pass_sum.h"
#include "core/render/render.h"

namespace exphoton {

struct StoppingRule {
  std::optional<double> targetError;  // noise part of relMSE, > 0; used alone, it ignores time
  std::optional<double> timeLimit;    // seconds from `start`, including preprocessing
  std::chrono::steady_clock::time_point start;
  std::int64_t maxSamples = kMaxSamples;  // per pixel
  // If positive, every pass is a group of its own with this number of samples per pixel, so that
  // passes do not depend on the pixels of earlier ones.
  std::int64_t passSamples = 0;
  // The error with its bias (accuracy_rule.h). `firstSamples` of each of the first two groups of
  // passes should be about half of what is needed.
  struct Accuracy {
    double error = 0;
    std::int64_t firstSamples = 1;
    double biasShare = .125;   // of the squared error, what certificates should resolve
    double photonSamples = 0;  // as in PassPlan::Limits
    double omitted = 0;        // as in AccuracyRule
    // Whether the picture may lose shared gathers where their bias is dear.
    bool mayStopSharing = false;
    double expectedSamples = 0;  // that the error takes; 0: not known
    // Whether the picture also stops where its bias is likely to be too large, to begin again.
    bool stopsForLikelyBias = false;
    int earlierLooks = 0;  // at renders that this one replaces; all share the 5 %
    // Whether each pass shares its gathers alone, so that shards can render it. The picture without
    // sharing is then not known, and each pass shows the bias of its own sharing.
    bool sharesApart = false;
    // What a rival costs, in samples per pixel of this picture. The picture stops if it is sure to
    // need far more of them (AccuracyRule::IsDearerThan).
    double rivalSamples = std::numeric_limits<double>::infinity();
  };
  std::optional<Accuracy> accuracy{};
  // Passes are progressive (progressive.h) with this alpha; nullopt: they are not. Needs
  // passSamples.
  std::optional<double> progressiveAlpha{};

  static constexpr std::int64_t kMaxSamples = std::int64_t(1) << 20;
};

// Renders at least one complete pass into the job's film and stops between passes only. The first
// passes have one sample per pixel, later ones more. Without a time limit, the numbers of samples
// and passes depend on the pixel values alone.
PassesResult RenderInPasses(const RenderJob& job, const RenderOptions& options,
                            const StoppingRule& rule);

}  // namespace exphoton
