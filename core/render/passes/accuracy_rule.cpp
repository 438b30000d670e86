// SPDX-License-Identifier: BSD-2-Clause
#include "core/render/passes/accuracy_rule.h"

#include <cmath>
#include <limits>
#include <numbers>

namespace exphoton {
namespace {

constexpr double kWrong = .05;          // the chance of any wrong look
constexpr double kWrongOmission = .01;  // the chance that the bound of omissions is too low

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

double AccuracyRule::Quantile(int look) const {
  const double wrong = omitted_ > 0 ? kWrong - kWrongOmission : kWrong;
  return NormalQuantile(wrong / (look * (look + 1.)));
}

CertificateGoal AccuracyRule::NextGoal() const {
  return {.smallest = biasShare_ * room_, .quantile = Quantile(looks_ + 1)};
}

double AccuracyRule::MostBias(const SharingBias& sharing) const {
  return std::max(sharing.squared, 0.) + Quantile(looks_) * sharing.standardError;
}

// Noise and bias are estimated from different random numbers, so the distances of their bounds add
// as squares.
void AccuracyRule::Look(const ErrorEstimate& estimate) {
  ++looks_;
  const Certificate* const certificate = estimate.certificate;
  const double bias = bias_ = certificate ? certificate->Bias() : 0;
  const double distance = std::hypot(Quantile(looks_) * estimate.noiseError,
                                     certificate ? certificate->UpperBias() - bias : 0);
  upper_ = estimate.noise + bias + distance;
  if (omitted_ > 0) upper_ = std::pow(std::sqrt(upper_) + omitted_, 2);
  lowerBias_ = certificate ? certificate->LowerBias() : 0;
  const double left = room_ - bias - estimate.fixedNoise;
  growth_ = left > 0 ? (estimate.noise - estimate.fixedNoise + distance) / left
                     : std::numeric_limits<double>::infinity();
}

}  // namespace exphoton
