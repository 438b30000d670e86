// SPDX-License-Identifier: BSD-2-Clause
// RenderInPasses: a picture as the mean of independent passes, each with its own camera samples and
// its own preprocessing (photon maps), until a rule says that it is enough. Derivation and
// measurements: docs/decisions/0007-stopping-rules.md.
#pragma once

#include <chrono>
#include <optional>

#include "core/imaging/film/pass_noise.h"
#include "core/render/render.h"

namespace exphoton {

struct StoppingRule {
  std::optional<double> targetError;  // noise part of relMSE, > 0; with it alone time has no say
  std::optional<double> timeLimit;    // seconds from `start`, preprocessing among them
  std::chrono::steady_clock::time_point start;
  std::int64_t maxSamples = kMostSamples;  // a pixel

  static constexpr std::int64_t kMostSamples = std::int64_t(1) << 20;
};

enum class StopReason { Samples, TargetError, TimeLimit, Signal };
const char* StopReasonName(StopReason reason);  // "target-error"

struct PassesResult {
  RenderResult render;
  StopReason reason = StopReason::Samples;  // Samples: all that were wanted, or maxSamples
  int passes = 0;                           // whole ones
  std::int64_t samplesPerPixel = 0;
  std::optional<double> noise;   // estimated noise part of relMSE; absent with one pass
  std::vector<float> variances;  // of each pixel, three channels; empty with one pass
};

// Renders into the job's film at least one whole pass, and stops between passes. A pass has one
// sample a pixel at first and more later; samples and passes depend on the pixels alone, unless
// there is a time limit.
PassesResult RenderInPasses(const RenderJob& job, const RenderOptions& options,
                            const StoppingRule& rule);

// Two passes of half the samples each (one more where their number is odd), the second into `other`
// alone; the job's film gets both.
PassesResult RenderTwoHalves(const RenderJob& job, const RenderOptions& options, Film* first,
                             Film* second);

}  // namespace exphoton
