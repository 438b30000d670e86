// SPDX-License-Identifier: BSD-2-Clause
#include "core/app/quote/missing_light.h"

#include <algorithm>
#include <cmath>

#include "core/base/format.h"

namespace exphoton::cli {

std::string MissingLight(const PilotMean& mean, std::span<const PilotMean> all) {
  constexpr double kStandardErrors = 4, kLeast = .02;
  const PilotMean& brightest = *std::ranges::max_element(all, {}, &PilotMean::mean);
  const double missing = 1 - mean.mean / brightest.mean;
  const double noise = std::hypot(mean.relativeError, brightest.relativeError);
  if (!(missing > kLeast + kStandardErrors * noise)) return "";
  return Format("finds %.3g %% less light than ", 100 * missing) + brightest.integrator;
}

}  // namespace exphoton::cli
