// SPDX-License-Identifier: BSD-2-Clause
// BlockBias estimates the squared bias of a picture from the corrections of independent groups of
// passes. Corrections are averaged over square blocks of pixels. The product of the means of two
// groups has the squared bias of the block as its expected value, if the noise of the groups is
// independent. Groups that continue one sequence of camera samples are so only nearly
// (docs/decisions/0081-one-sequence-for-an-accuracy.md). What varies inside a block is not covered.
// The derivation of the interval is in docs/decisions/0050-bias-certificate.md.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace exphoton {

// The normal quantile of a two-sided interval of 95 %.
inline constexpr double kQuantile95 = 1.96;

// An estimate with its interval, in the unit of relMSE.
struct BlockBias {
  int blockWidth = 0;  // pixels
  int blocks = 0;
  double squared = 0;  // may be negative by chance
  double lower = 0, upper = 0;
  double smallest = 0;        // the upper end of the interval of an estimate of 0
  int width = 0, height = 0;  // of the largest block, which is no larger than the picture

  // Returns a quantity of relMSE as an error: its root, or 0 for negative values.
  static double Root(double squared);
};

class BlockBiasEstimator {
 public:
  // The relative corrections of one group: of each pixel, three channels, divided by
  // sqrt(r^2 + 0.01) for the radiance r of the picture.
  struct Group {
    std::span<const float> pixels;
    double share;  // of the samples of all groups
  };
  static constexpr int kCell = 4;  // pixels; the spread between groups in each cell gives the noise
  static constexpr int kFinestBlock = kCell;

  // There must be two groups or more. All groups have the same size. The normal quantile decides
  // how wide the intervals are.
  BlockBiasEstimator(int width, int height, std::span<const Group> groups,
                     double quantile = kQuantile95);

  // Returns the estimate for blocks of this width, a multiple of kCell.
  BlockBias Estimate(int blockWidth) const;
  // Returns the estimate for the finest blocks that can certify a bias of `wanted` (relMSE), or
  // the estimate of the block width that can certify the smallest bias. The choice depends on the
  // noise of the corrections and hardly on their mean.
  BlockBias EstimateFor(double wanted) const;

 private:
  // Sums over the pixels of one cell or of one block.
  struct Sums {
    double pixels = 0;
    std::vector<std::array<double, 3>> groups;  // relative corrections
    std::array<double, 6> covariance{};         // of the sums of the weighted mean of all groups
  };
  struct Noise;

  void AddCell(const Sums& cell, Sums* block) const;
  // Returns the weighted mean of a block, over the groups.
  std::array<double, 3> MeanOf(const Sums& block) const;
  // Returns the mean over channels of the squared mean of all groups. It contains noise.
  double SquareOf(const Sums& block) const;
  // Returns the mean over pairs of groups of the products of their means.
  double ProductOf(const Sums& block) const;
  Noise NoiseOf(const std::vector<Sums>& blocks) const;
  double CommonVariance() const;
  double Quantile() const;

  int width_, height_;  // of the picture
  int columns_, rows_;  // of cells
  double quantile_;
  std::vector<double> shares_;
  double pairShare_;  // 1 - sum of shares^2
  std::vector<Sums> cells_;
};

}  // namespace exphoton
