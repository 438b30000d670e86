// SPDX-License-Identifier: BSD-2-Clause
#include "core/render/certificate/relative_corrections.h"

#include <algorithm>
#include <cmath>

#include "core/imaging/metrics/metrics.h"
#include "core/render/certificate/corrections.h"

namespace exphoton {
namespace {

// Few corrections are noisy, so those of one cell change radiance by the first factor at most, and
// all of them together by the second one.
constexpr double kLeastFactor = .5, kLeastRadiance = .25;

}  // namespace

RelativeCorrections::RelativeCorrections(const Corrections& corrections)
    : width_(corrections.Crop().Width()), height_(corrections.Crop().Height()) {
  const auto groups = corrections.Groups();
  double samples = 0;
  for (const auto* group : groups) samples += double(group->samplesPerPixel);
  for (const auto* group : groups) {
    std::vector<double>& means = groups_.emplace_back(corrections.SumsOf(*group));
    for (double& mean : means) mean /= double(group->samplesPerPixel);
    shares_.push_back(double(group->samplesPerPixel) / samples);
  }
}

BlockBiasEstimator RelativeCorrections::To(std::span<const double> levels, double quantile) const {
  std::vector<std::vector<float>> relative;
  std::vector<BlockBiasEstimator::Group> inputs;
  for (const std::vector<double>& means : groups_) {
    std::vector<float>& values = relative.emplace_back(levels.size());
    for (std::size_t i = 0; i < levels.size(); ++i)
      values[i] = float(means[i] / std::sqrt(levels[i] + kRelMseOffset));
  }
  for (std::size_t g = 0; g < groups_.size(); ++g) inputs.push_back({relative[g], shares_[g]});
  return BlockBiasEstimator(width_, height_, inputs, quantile);
}

template <class Use>
void RelativeCorrections::ForEachValue(std::size_t cellWidth, const Use& use) const {
  const auto width = std::size_t(width_), height = std::size_t(height_);
  const std::size_t columns = (width + cellWidth - 1) / cellWidth;
  std::size_t value = 0;
  for (std::size_t y = 0; y < height; ++y) {
    for (std::size_t x = 0; x < width; ++x) {
      const std::size_t place = 3 * (y / cellWidth * columns + x / cellWidth);
      const Parity parity = (x + y) % 2 == 0 ? Parity::Even : Parity::Odd;
      for (std::size_t c = 0; c < 3; ++c) use(value++, place + c, parity);
    }
  }
}

std::vector<RelativeCorrections::Cell> RelativeCorrections::CellsOf(
    std::span<const double> picture, std::span<const double> corrected, std::size_t width,
    Parity parity) const {
  const std::size_t columns = (std::size_t(width_) + width - 1) / width;
  const std::size_t rows = (std::size_t(height_) + width - 1) / width;
  std::vector<Cell> cells(3 * columns * rows);
  for (Cell& cell : cells) cell.corrections.resize(groups_.size());
  ForEachValue(width, [&](std::size_t i, std::size_t place, Parity ofValue) {
    if (ofValue != parity) return;
    Cell& cell = cells[place];
    cell.picture += picture[i], cell.corrected += corrected[i];
    for (std::size_t g = 0; g < groups_.size(); ++g) cell.corrections[g] += groups_[g][i];
  });
  return cells;
}

std::vector<double> RelativeCorrections::TrueRadiance(std::span<const double> picture,
                                                      std::size_t blockWidth, Parity parity) const {
  std::vector<double> corrected(picture.begin(), picture.end());
  for (std::size_t width = blockWidth;; width = std::max(width / 2, kFinest)) {
    std::vector<double> factors;
    for (const Cell& cell : CellsOf(picture, corrected, width, parity))
      factors.push_back(FactorOf(cell));
    ForEachValue(width, [&](std::size_t i, std::size_t place, Parity) {
      corrected[i] = std::clamp(corrected[i] * factors[place], kLeastRadiance * picture[i],
                                picture[i] / kLeastRadiance);
    });
    if (width <= kFinest) return corrected;
  }
}

// A correction that is large by chance would make its own level small, and so count for more. So
// the level of each pixel follows from the corrections of the pixels of the other parity.
std::vector<double> RelativeCorrections::TrueLevels(std::span<const double> levels,
                                                    std::size_t blockWidth) const {
  std::vector<double> picture;
  for (const double level : levels) picture.push_back(std::sqrt(level));
  const std::vector<double> even = TrueRadiance(picture, blockWidth, Parity::Even);
  std::vector<double> corrected = TrueRadiance(picture, blockWidth, Parity::Odd);
  ForEachValue(blockWidth, [&](std::size_t i, std::size_t, Parity parity) {
    if (parity == Parity::Odd) corrected[i] = even[i];
    corrected[i] *= corrected[i];
  });
  return corrected;
}

// Returns the true radiance of a cell relative to its corrected one. The part of the corrections
// that groups do not agree on is noise: the product of two groups has their squared mean without
// noise as its expected value, and divided by the squared mean with noise it is the part to keep.
double RelativeCorrections::FactorOf(const Cell& cell) const {
  double mean = 0, own = 0, pairs = 1;
  for (std::size_t g = 0; g < shares_.size(); ++g) {
    const double missing = shares_[g] * (cell.corrections[g] - (cell.corrected - cell.picture));
    mean += missing;
    own += missing * missing;
    pairs -= shares_[g] * shares_[g];
  }
  if (!(cell.corrected > 0) || !(mean * mean > 0)) return 1;
  const double kept = std::clamp((mean * mean - own) / (pairs * mean * mean), 0., 1.);
  return std::clamp(1 + kept * mean / cell.corrected, kLeastFactor, 1 / kLeastFactor);
}

}  // namespace exphoton
