// SPDX-License-Identifier: BSD-2-Clause
#include "core/render/passes/unshared/bias_of_sharing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "core/imaging/metrics/metrics.h"
#include "core/render/passes/cancelling_errors.h"

namespace exphoton {
namespace {

constexpr std::size_t kCell = 8;  // pixels; the noise of cells is nearly independent

// The first and the later groups, with about the same number of samples.
struct SampleHalves {
  std::array<std::vector<int>, 2> groups;
  std::array<std::int64_t, 2> samples{};

  explicit SampleHalves(const PassNoise& picture) {
    std::int64_t all = 0;
    for (int group = 0; group < picture.Places(); ++group) all += picture.SamplesOf(group);
    for (int group = 0; group < picture.Places(); ++group) {
      const std::int64_t count = picture.SamplesOf(group);
      if (count <= 0) continue;
      // The group belongs to the first half if most of it lies there.
      const bool isFirst = samples[0] == 0 || (samples[1] == 0 && 2 * samples[0] + count <= all);
      groups[isFirst ? 0 : 1].push_back(group);
      samples[isFirst ? 0 : 1] += count;
    }
  }
  bool AreTwo() const { return !groups[1].empty(); }
};

// The differences between the pictures with and without sharing in one half, three channels per
// pixel. The mean of their squares has the unit of relMSE.
std::vector<double> RelativeDifferences(const PassNoise& shared, const PassNoise& unshared,
                                        const std::vector<int>& groups) {
  const std::vector<double>& levels = unshared.Levels();
  std::vector<double> values = shared.MeansOf(groups);
  const std::vector<double> own = unshared.MeansOf(groups);
  for (std::size_t i = 0; i < values.size(); ++i)
    values[i] = (values[i] - own[i]) / std::sqrt(levels[i] + kRelMseOffset);
  return values;
}

// Returns the standard deviation of the sum of a b. Let x and y be the noise of a and b, and let
// the variance of y be q^2 times the variance of x. Then x - y and q x + y / q are uncorrelated, so
// (a - b) (q a + b / q) / 2 has the mean 0, whatever the bias is. For q = 1 and normal noise its
// variance equals the one of a b, and otherwise it is larger. The noise of cells is independent.
// The deviation is Student's: deviations of results in units of it have the variance 1, also where
// few cells have all noise.
double DeviationOfProducts(const std::vector<double>& a, const std::vector<double>& b, double q,
                           std::size_t width) {
  const std::size_t columns = (width + kCell - 1) / kCell, row = 3 * width;
  std::vector<double> cells((a.size() / row + kCell - 1) / kCell * columns);
  for (std::size_t i = 0; i < a.size(); ++i)
    cells[i / row / kCell * columns + i % row / 3 / kCell] +=
        (a[i] - b[i]) * (q * a[i] + b[i] / q) / 2;
  double squares = 0, fourths = 0;
  for (const double cell : cells) {
    squares += cell * cell;
    fourths += cell * cell * cell * cell;
  }
  // The number of normal cells of equal variance that would spread like these.
  const double freedom = fourths > 0 ? std::max(3 * squares * squares / fourths, 3.) : 3.;
  return std::sqrt(squares * freedom / (freedom - 2));
}

// Returns what the products of two halves lack for each unit of their squared difference. Let the
// squared error of a half be V and the covariance of the halves C. With the ratio r of errors,
// (V + C) / 2 = r V, and the squared difference is 2 (V - C) = 4 V (1 - r).
double CancelledPart(double ratio) { return (1 - 2 * ratio) / (4 * (1 - ratio)); }

}  // namespace

std::optional<SharingBias> BiasOfSharing(const PassNoise& shared, const PassNoise& unshared,
                                         GroupSamples samples) {
  const SampleHalves halves(shared);
  if (!halves.AreTwo()) return std::nullopt;
  const std::vector<double> a = RelativeDifferences(shared, unshared, halves.groups[0]);
  const std::vector<double> b = RelativeDifferences(shared, unshared, halves.groups[1]);
  double products = 0, difference = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    products += a[i] * b[i];
    difference += (a[i] - b[i]) * (a[i] - b[i]);
  }
  if (samples == GroupSamples::OneSequence)
    products += CancelledPart(kUsualErrorRatio) * difference;
  const double q = std::sqrt(double(halves.samples[0]) / double(halves.samples[1]));
  const double deviation = DeviationOfProducts(a, b, q, shared.Width());
  const auto count = double(a.size());
  return SharingBias{products / count, deviation / count};
}

}  // namespace exphoton
