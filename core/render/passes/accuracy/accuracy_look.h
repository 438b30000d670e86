// SPDX-License-Identifier: BSD-2-Clause
// LookAtError lets an AccuracyRule look at the passes so far. Renders and merges of shards use it,
// so that both stop after the same pass.
#pragma once

#include <optional>

#include "core/base/log.h"
#include "core/render/certificate/corrections.h"
#include "core/render/passes/accuracy/accuracy_rule.h"
#include "core/render/passes/pass_sum.h"

namespace exphoton {

// The passes of a picture, at least two groups.
struct LookedAtPasses {
  const PassSum& sum;
  const Corrections* corrections = nullptr;  // null: the integrator has no bias
  std::optional<SharingBias> sharing{};      // of shared gathers; nullopt: there is none
  double fixedNoise = 0, photonNoise = 0;    // as in ErrorEstimate
  const Certificate* ofMaps = nullptr;       // as in ErrorEstimate
};

// Returns the certificate of the passes; nullopt without corrections.
std::optional<Certificate> LookAtError(const LookedAtPasses& passes, AccuracyRule* rule, Log& log);

}  // namespace exphoton
