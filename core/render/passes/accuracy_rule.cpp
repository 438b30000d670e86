// SPDX-License-Identifier: BSD-2-Clause
#include "core/render/passes/accuracy_rule.h"

#include <cmath>
#include <limits>
#include <numbers>

namespace exphoton {
namespace {

constexpr double kWrong = .05;  // the chance of any wrong look

double QuantileOfLook(int look) { return NormalQuantile(kWrong / (look * (look + 1.))); }

}  // namespace

// Bisection of P(Z > z) = erfc(z / sqrt(2)) / 2.
double NormalQuantile(double probability) {
  double low = 0, high = 40;
  for (int i = 0; i < 60; ++i) {
    const double middle = (low + high) / 2;
    (std::erfc(middle / std::numbers::sqrt2) / 2 > probability ? low : high) = middle;
  }
  return (low + high) / 2;
}

CertificateGoal AccuracyRule::NextGoal() const {
  return {.smallest = biasShare_ * wanted_, .quantile = QuantileOfLook(looks_ + 1)};
}

// Noise and bias are estimated from different random numbers, so the distances of their bounds add
// as squares.
void AccuracyRule::Look(const ErrorEstimate& estimate) {
  ++looks_;
  const Certificate* const certificate = estimate.certificate;
  const double bias = certificate ? certificate->Bias() : 0;
  const double distance = std::hypot(QuantileOfLook(looks_) * estimate.noiseError,
                                     certificate ? certificate->UpperBias() - bias : 0);
  upper_ = estimate.noise + bias + distance;
  lowerBias_ = certificate ? certificate->LowerBias() : 0;
  growth_ = bias < wanted_ ? (estimate.noise + distance) / (wanted_ - bias)
                           : std::numeric_limits<double>::infinity();
}

}  // namespace exphoton
