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

// Returns whether the light of `other` shows that the mean lacks light.
bool LacksLight(const MeanLight& mean, const MeanLight& other, const LightTest& test) {
  const double missing = 1 - mean.mean / other.mean;
  if (!(missing > test.leastMissing)) return false;
  const double noise = std::hypot(mean.relativeError, other.relativeError);
  const double freedom = FreedomOf(mean, other);
  const double t = (missing - test.leastMissing) / noise;
  return !(noise > 0) || StudentTail(t, std::min(freedom, kMostFreedom)) < test.mostChance;
}

}  // namespace

std::string MissingLight(const PilotMean& mean, std::span<const PilotMean> all,
                         const LightTest& test) {
  const PilotMean* brightest = nullptr;
  for (const PilotMean& other : all)
    if ((!brightest || other.light.mean > brightest->light.mean) &&
        LacksLight(mean.light, other.light, test))
      brightest = &other;
  if (!brightest) return "";
  const double missing = 1 - mean.light.mean / brightest->light.mean;
  return Format("finds %.3g %% less light than ", 100 * missing) + brightest->integrator;
}

}  // namespace exphoton::cli
