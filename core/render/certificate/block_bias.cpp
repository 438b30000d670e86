// SPDX-License-Identifier: BSD-2-Clause
// BlockBiasEstimator: cells, blocks, and the interval by inversion of a test.
#include "core/render/certificate/block_bias.h"

#include <algorithm>
#include <cmath>

#include "core/render/certificate/noncentral_chi_square.h"

namespace exphoton {
namespace {

// The places of the six different elements of a symmetric matrix.
constexpr int kRow[6] = {0, 1, 2, 0, 0, 1}, kColumn[6] = {0, 1, 2, 1, 2, 2};

double Trace(const std::array<double, 6>& m) { return m[0] + m[1] + m[2]; }

// Returns the sum of the squares of all nine elements.
double SumOfSquares(const std::array<double, 6>& m) {
  double sum = 0;
  for (std::size_t i = 0; i < 6; ++i) sum += (i < 3 ? 1 : 2) * m[i] * m[i];
  return sum;
}

// Solves (estimate - x)^2 = z^2 (fixed + slope x) for x. Returns the smaller root.
double LowerBound(double estimate, double z2, double fixed, double slope) {
  const double half = estimate + z2 * slope / 2;
  return half - std::sqrt(std::max(half * half - estimate * estimate + z2 * fixed, 0.));
}

}  // namespace

// The variance of the estimate is fixed + slope * (squared bias). The mean of the squares of all
// blocks without bias has the mean `mean`, and `freedom` degrees of freedom.
struct BlockBiasEstimator::Noise {
  double fixed = 0, slope = 0;
  double mean = 0, freedom = 1;

  // Returns the upper end of the interval of the squared bias, for the mean of the squares.
  double UpperEnd(double squares, double z) const {
    if (!(mean > 0)) return squares;
    const double unit = mean / freedom;
    return unit * NoncentralityBound(std::max(squares, mean) / unit, freedom, z);
  }
};

double BlockBias::Root(double squared) { return std::sqrt(std::max(squared, 0.)); }

BlockBiasEstimator::BlockBiasEstimator(int width, int height, std::span<const Group> groups,
                                       double quantile)
    : width_(width),
      height_(height),
      columns_((width + kCell - 1) / kCell),
      rows_((height + kCell - 1) / kCell),
      quantile_(quantile),
      pairShare_(1),
      cells_(std::size_t(columns_) * std::size_t(rows_)) {
  for (const Group& group : groups) {
    shares_.push_back(group.share);
    pairShare_ -= group.share * group.share;
  }
  for (Sums& cell : cells_) cell.groups.resize(groups.size());
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      Sums& cell = cells_[std::size_t(y / kCell) * std::size_t(columns_) + std::size_t(x / kCell)];
      const std::size_t pixel = std::size_t(y) * std::size_t(width) + std::size_t(x);
      for (std::size_t g = 0; g < groups.size(); ++g)
        for (std::size_t c = 0; c < 3; ++c)
          cell.groups[g][c] += double(groups[g].pixels[3 * pixel + c]);
      ++cell.pixels;
    }
  }
  for (Sums& cell : cells_) {
    std::array<double, 3> mean{};
    for (std::size_t g = 0; g < groups.size(); ++g)
      for (std::size_t c = 0; c < 3; ++c) mean[c] += shares_[g] * cell.groups[g][c];
    for (std::size_t i = 0; i < 6; ++i)
      for (std::size_t g = 0; g < groups.size(); ++g)
        cell.covariance[i] += shares_[g] * (cell.groups[g][kRow[i]] - mean[kRow[i]]) *
                              (cell.groups[g][kColumn[i]] - mean[kColumn[i]]) /
                              double(groups.size() - 1);
  }
}

void BlockBiasEstimator::AddCell(const Sums& cell, Sums* block) const {
  block->groups.resize(shares_.size());
  block->pixels += cell.pixels;
  for (std::size_t g = 0; g < shares_.size(); ++g)
    for (std::size_t c = 0; c < 3; ++c) block->groups[g][c] += cell.groups[g][c];
  for (std::size_t i = 0; i < 6; ++i) block->covariance[i] += cell.covariance[i];
}

std::array<double, 3> BlockBiasEstimator::MeanOf(const Sums& block) const {
  std::array<double, 3> mean{};
  for (std::size_t g = 0; g < shares_.size(); ++g)
    for (std::size_t c = 0; c < 3; ++c) mean[c] += shares_[g] * block.groups[g][c] / block.pixels;
  return mean;
}

// The sum over all ordered pairs of different groups is the square of the sum minus the squares.
double BlockBiasEstimator::SquareOf(const Sums& block) const {
  const std::array<double, 3> mean = MeanOf(block);
  return (mean[0] * mean[0] + mean[1] * mean[1] + mean[2] * mean[2]) / 3;
}

double BlockBiasEstimator::ProductOf(const Sums& block) const {
  const std::array<double, 3> mean = MeanOf(block);
  double product = 0;
  for (std::size_t c = 0; c < 3; ++c) {
    product += mean[c] * mean[c];
    for (std::size_t g = 0; g < shares_.size(); ++g) {
      const double own = shares_[g] * block.groups[g][c] / block.pixels;
      product -= own * own;
    }
  }
  return product / (3 * pairShare_);
}

// Photons that are missing in one group make all of its blocks wrong in the same way. This noise
// does not show between cells, but it shows between the groups' means of the whole picture.
double BlockBiasEstimator::CommonVariance() const {
  Sums all;
  for (const Sums& cell : cells_) AddCell(cell, &all);
  const std::array<double, 3> mean = MeanOf(all);
  double spread = 0;
  for (std::size_t c = 0; c < 3; ++c)
    for (std::size_t g = 0; g < shares_.size(); ++g) {
      const double difference = all.groups[g][c] / all.pixels - mean[c];
      spread += shares_[g] * difference * difference / double(shares_.size() - 1);
    }
  return std::max(spread - Trace(all.covariance) / (all.pixels * all.pixels), 0.) / 3;
}

BlockBiasEstimator::Noise BlockBiasEstimator::NoiseOf(const std::vector<Sums>& blocks) const {
  double pixels = 0, common = CommonVariance(), linear = 0;
  for (const Sums& block : blocks) pixels += block.pixels;
  for (const double share : shares_) linear += share * (1 - share) * (1 - share);
  linear /= pairShare_ * pairShare_;
  Noise noise;
  double mean = 0, squares = 0;  // of the traces, weighted by area
  for (const Sums& block : blocks) {
    const double area = block.pixels / pixels, scale = 1 / (block.pixels * block.pixels);
    noise.fixed += area * area * SumOfSquares(block.covariance) * scale * scale / 9;
    const double trace = Trace(block.covariance) * scale;
    mean += area * trace;
    squares += area * area * trace * trace;
  }
  noise.mean = mean / 3 + common;
  noise.freedom = noise.mean * noise.mean / (squares / 9 + common * common);
  noise.fixed = 2 / pairShare_ * (noise.fixed + common * common);
  noise.slope = 4 * linear * ((mean > 0 ? squares / mean / 3 : 0) + common);
  return noise;
}

// Student's t for the number of normal values whose squares would spread like those of the cells,
// by the first terms of its expansion (Abramowitz and Stegun 1964, 26.7.5).
double BlockBiasEstimator::Quantile() const {
  double sum = 0, squares = 0;
  for (const Sums& cell : cells_) {
    const double trace = Trace(cell.covariance);
    sum += trace;
    squares += trace * trace;
  }
  const double freedom = squares > 0 ? std::max(3 * sum * sum / squares, 2.) : 1e9;
  const double z = quantile_, z3 = z * z * z, z5 = z3 * z * z;
  return z + (z3 + z) / (4 * freedom) + (5 * z5 + 16 * z3 + 3 * z) / (96 * freedom * freedom);
}

BlockBias BlockBiasEstimator::Estimate(int blockWidth) const {
  const int cells = std::max(blockWidth / kCell, 1);
  const int columns = (columns_ + cells - 1) / cells, rows = (rows_ + cells - 1) / cells;
  std::vector<Sums> blocks(std::size_t(columns) * std::size_t(rows));
  for (int y = 0; y < rows_; ++y)
    for (int x = 0; x < columns_; ++x)
      AddCell(cells_[std::size_t(y * columns_ + x)],
              &blocks[std::size_t(y / cells * columns + x / cells)]);
  BlockBias bias;
  bias.blockWidth = blockWidth;
  bias.blocks = columns * rows;
  bias.width = std::min(blockWidth, width_), bias.height = std::min(blockWidth, height_);
  double pixels = 0, squares = 0;
  for (const Sums& block : blocks) {
    bias.squared += block.pixels * ProductOf(block);
    squares += block.pixels * SquareOf(block);
    pixels += block.pixels;
  }
  bias.squared /= pixels, squares /= pixels;
  const Noise noise = NoiseOf(blocks);
  const double z = Quantile(), z2 = z * z;
  bias.lower = std::max(LowerBound(bias.squared, z2, noise.fixed, noise.slope), 0.);
  bias.smallest = noise.UpperEnd(0, z);
  bias.upper = std::max(noise.UpperEnd(squares, z), bias.squared);
  return bias;
}

BlockBias BlockBiasEstimator::EstimateFor(double wanted) const {
  const int most = std::max(columns_, rows_) * kCell;
  BlockBias best;
  for (int width = kFinestBlock;; width *= 2) {
    const BlockBias bias = Estimate(std::min(width, most));
    if (best.blocks == 0 || bias.smallest < best.smallest) best = bias;
    if (bias.smallest <= wanted || width >= most) break;
  }
  return best;
}

}  // namespace exphoton
