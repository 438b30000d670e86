// SPDX-License-Identifier: BSD-2-Clause
#include "core/app/quote/missing_light.h"

#include <algorithm>
#include <cmath>

#include "core/base/format.h"
#include "core/imaging/metrics/noise_test.h"

namespace exphoton::cli {
namespace {

constexpr double kMostFreedom = 1e6;

// Degrees of freedom of the difference of two means (Welch 1947).
double FreedomOf(const MeanLight& a, const MeanLight& b) {
  const double first = a.relativeError * a.relativeError;
  const double second = b.relativeError * b.relativeError;
  return (first + second) * (first + second) /
         (first * first / a.freedom + second * second / b.freedom);
}

}  // namespace

std::string MissingLight(const PilotMean& mean, std::span<const PilotMean> all,
                         const LightTest& test) {
  const PilotMean& brightest =
      *std::ranges::max_element(all, {}, [](const PilotMean& pilot) { return pilot.light.mean; });
  const double missing = 1 - mean.light.mean / brightest.light.mean;
  if (!(missing > test.leastMissing)) return "";
  const double noise = std::hypot(mean.light.relativeError, brightest.light.relativeError);
  const double freedom = FreedomOf(mean.light, brightest.light);
  const double t = (missing - test.leastMissing) / noise;
  if (noise > 0 && !(StudentTail(t, std::min(freedom, kMostFreedom)) < test.mostChance)) return "";
  return Format("finds %.3g %% less light than ", 100 * missing) + brightest.integrator;
}

}  // namespace exphoton::cli
