// SPDX-License-Identifier: BSD-2-Clause
#include "core/render/passes/accuracy/accuracy_rule.h"

#include <cmath>
#include <limits>
#include <numbers>

#include "core/files/byte_archive.h"
#include "core/math/chi_square.h"
#include "core/render/passes/photons/photon_sets.h"

namespace exphoton {
namespace {

constexpr double kWrong = .05;          // the chance of any wrong look
constexpr double kWrongOmission = .01;  // the chance that any bound of an omission is too low

// Returns how far the upper end of the interval of the noise lies above its estimate. The noise
// exceeds this end with the given chance, which is P(Z > z) for a standard normal Z. With many
// degrees of freedom, the result uses the approximation of Wilson and Hilferty 1931, "The
// Distribution of Chi-Square".
double NoiseDistance(const ErrorEstimate& estimate, double chance, double z) {
  constexpr double kMany = 1000;
  const double degrees = estimate.freedom;
  if (!std::isfinite(degrees)) return z * estimate.noiseError;
  const double c = 2 / (9 * degrees);
  const double lowest = degrees < kMany ? ChiSquareQuantile(chance, degrees)
                                        : degrees * std::pow(1 - c - z * std::sqrt(c), 3);
  return estimate.betweenGroups * (degrees / lowest - 1);
}

// The interval of the bias lies this far above its estimate (relMSE). The noise of the corrections
// falls as 1 / samples, and the interval becomes narrower until it can certify the smallest bias
// that is wanted. Then certificates take finer blocks, which keep its width, as long as there are
// any: blocks of half the width have twice the noise.
struct BiasDistance {
  double now = 0;       // at the look
  double smallest = 0;  // the part that there would be without bias
  double wanted = 0;    // of this part
  double finer = 1;     // the width of the blocks, in widths of the finest ones

  // The other part is the root of the product of the bias and the noise of the corrections, so both
  // parts follow from the factor by which this noise falls.
  double After(double growth) const {
    const double enough = smallest > wanted ? wanted / smallest : 1;
    const double factor = std::max(1 / growth, std::min(enough, finer / growth));
    const double other = std::max(now * now - smallest * smallest, 0.);
    return std::sqrt(std::max(smallest * smallest * factor * factor + other * factor, 0.));
  }
};

// Parts of the error (relMSE) at a look. `noise` and its distance are inversely proportional to the
// samples.
struct ErrorParts {
  double noise = 0, noiseDistance = 0;
  double sharing = 0, fixed = 0;
  BiasDistance bias = {};
};

// Returns the factor by which the number of samples must grow until the parts fit into the room.
// Bisection of its logarithm.
double GrowthUntil(const ErrorParts& parts, double room) {
  constexpr double kMost = 0x1p40;
  const auto fits = [&](double growth) {
    const double sharing = parts.sharing * std::pow(growth, -kSharingSlope);
    const double distance = std::hypot(parts.noiseDistance / growth, parts.bias.After(growth));
    return parts.noise / growth + sharing + parts.fixed + distance <= room;
  };
  if (!fits(kMost)) return std::numeric_limits<double>::infinity();
  double low = -40, high = 40;
  for (int i = 0; i < 60; ++i) {
    const double middle = (low + high) / 2;
    (fits(std::exp2(middle)) ? high : low) = middle;
  }
  return std::exp2(high);
}

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

double AccuracyRule::WrongChance(int look) const {
  const double wrong = omitted_ > 0 ? kWrong - kWrongOmission : kWrong;
  return wrong / (look * (look + 1.));
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
  const double z = Quantile(looks_), ofBias = certificate ? certificate->UpperBias() - bias : 0;
  const double distance = std::hypot(NoiseDistance(estimate, WrongChance(looks_), z), ofBias);
  upper_ = estimate.noise + bias + distance;
  if (omitted_ > 0) upper_ = std::pow(std::sqrt(upper_) + omitted_, 2);
  lowerBias_ = certificate ? certificate->LowerBias() : 0;
  // Groups with the same photons show the noise of these photons as a bias.
  const Certificate* const ofMaps = estimate.ofMaps ? estimate.ofMaps : certificate;
  mapBias_ = ofMaps ? ofMaps->bias.squared - estimate.photonNoise : 0;
  lowerMapBias_ = ofMaps ? ofMaps->bias.lower - estimate.photonNoise : 0;
  const bool isKept = PhotonSets::AreKept(estimate.fixedNoise, RoomForNoise());
  const double fixed = isKept ? estimate.fixedNoise : 0;
  const bool isShared = certificate && certificate->sharing;
  const double sharing = isShared ? std::max(certificate->sharing->squared, 0.) : 0;
  BiasDistance biasDistance{ofBias};
  if (certificate) {
    biasDistance.smallest = certificate->bias.smallest;
    biasDistance.wanted = biasShare_ * room_;
    biasDistance.finer =
        std::max(double(certificate->bias.blockWidth) / BlockBiasEstimator::kFinestBlock, 1.);
  }
  growth_ = GrowthUntil({estimate.noise - fixed, z * estimate.noiseError, sharing,
                         fixed + bias - sharing, biasDistance},
                        room_);
  const double leastNoise = std::max(estimate.noise - estimate.noiseError - fixed, 0.);
  leastGrowth_ =
      IsOutOfReach() ? 1 : GrowthUntil({.noise = leastNoise, .fixed = fixed}, room_ - lowerBias_);
}

void AccuracyRule::Transfer(ByteArchive* archive) {
  constexpr int kMostLooks = 1 << 30;
  archive->Values(&looks_, &upper_, &bias_, &lowerBias_, &growth_);
  archive->Values(&mapBias_, &lowerMapBias_, &leastGrowth_);
  const bool isPossible = looks_ >= 0 && looks_ <= kMostLooks && upper_ >= 0 && bias_ >= 0 &&
                          lowerBias_ >= 0 && growth_ >= 0 && leastGrowth_ >= 0 &&
                          std::isfinite(mapBias_) && std::isfinite(lowerMapBias_);
  if (!isPossible) throw ArchiveError("its looks at the error are impossible");
}

}  // namespace exphoton
