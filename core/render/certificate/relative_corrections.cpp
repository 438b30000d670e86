// SPDX-License-Identifier: BSD-2-Clause
#include "core/render/certificate/relative_corrections.h"

#include <algorithm>
#include <cmath>

#include "core/imaging/metrics/metrics.h"
#include "core/render/certificate/corrections.h"

namespace exphoton {
namespace {

// Few corrections are noisy, so they change the radiance of a block by this factor at most.
constexpr double kLeastFactor = .5;

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

// Returns the place of the sums that a value of a pixel and channel belongs to.
std::size_t RelativeCorrections::PlaceOf(std::size_t value, std::size_t blockWidth) const {
  const auto width = std::size_t(width_);
  const std::size_t columns = (width + blockWidth - 1) / blockWidth;
  const std::size_t x = value / 3 % width, y = value / 3 / width;
  return 3 * (y / blockWidth * columns + x / blockWidth) + value % 3;
}

std::vector<RelativeCorrections::Block> RelativeCorrections::BlocksOf(
    std::span<const double> levels, std::size_t blockWidth) const {
  std::vector<Block> blocks(PlaceOf(levels.size() - 1, blockWidth) + 1);
  for (std::size_t i = 0; i < levels.size(); ++i) {
    Block& block = blocks[PlaceOf(i, blockWidth)];
    block.picture += std::sqrt(levels[i]);
    block.corrections.resize(groups_.size());
    for (std::size_t g = 0; g < groups_.size(); ++g)
      block.corrections[g] += shares_[g] * groups_[g][i];
  }
  return blocks;
}

std::vector<double> RelativeCorrections::TrueLevels(std::span<const double> levels,
                                                    std::size_t blockWidth) const {
  const std::vector<Block> blocks = BlocksOf(levels, blockWidth);
  std::vector<double> corrected(levels.begin(), levels.end());
  for (std::size_t i = 0; i < levels.size(); ++i) {
    const double factor = FactorOf(blocks[PlaceOf(i, blockWidth)]);
    corrected[i] *= factor * factor;
  }
  return corrected;
}

// Returns the true radiance of a block relative to the picture's. The part of the corrections that
// groups do not agree on is noise: the product of two groups has their squared mean without noise
// as its expected value, and divided by the squared mean with noise it is the part to keep.
double RelativeCorrections::FactorOf(const Block& block) const {
  double mean = 0, own = 0, pairs = 1;
  for (std::size_t g = 0; g < shares_.size(); ++g) {
    mean += block.corrections[g];
    own += block.corrections[g] * block.corrections[g];
    pairs -= shares_[g] * shares_[g];
  }
  if (!(block.picture > 0) || !(mean * mean > 0)) return 1;
  const double kept = std::clamp((mean * mean - own) / (pairs * mean * mean), 0., 1.);
  return std::clamp(1 + kept * mean / block.picture, kLeastFactor, 1 / kLeastFactor);
}

}  // namespace exphoton
