// SPDX-License-Identifier: BSD-2-Clause
// RelativeCorrections divides the corrections of the groups of passes by the radiance of the
// picture, so that their squared mean is a part of relMSE (BlockBiasEstimator). It also estimates
// the levels of the true picture. docs/decisions/0050-bias-certificate.md has the measurements.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/render/certificate/block_bias.h"

namespace exphoton {

class Corrections;

class RelativeCorrections {
 public:
  // There must be two groups.
  explicit RelativeCorrections(const Corrections& corrections);

  // Returns an estimator of the bias relative to levels r^2, three channels per pixel.
  BlockBiasEstimator To(std::span<const double> levels, double quantile) const;

  // Returns the levels of the true picture. Those of the picture contain its bias: a picture that
  // is 30 % too bright has a bias of 30 % of the truth, which is 23 % of the picture. Radiance is
  // multiplied by the factors that the mean corrections of blocks of this width (pixels) give, then
  // of cells of half of the width, and so on, and at last of cells of kFinest. The level of a noisy
  // pixel is larger than its squared radiance (core/imaging/film/local_square.h), which makes these
  // factors a little smaller than they should be.
  std::vector<double> TrueLevels(std::span<const double> levels, std::size_t blockWidth) const;
  static constexpr std::size_t kFinest = 8;  // pixels

 private:
  // The pixels with x + y even, or odd.
  enum class Parity { Even, Odd };
  struct Cell {  // sums over pixels, in one channel
    double picture = 0, corrected = 0;
    std::vector<double> corrections;  // of the groups
  };

  // Returns the radiance that pixels of one parity give for all pixels.
  std::vector<double> TrueRadiance(std::span<const double> picture, std::size_t blockWidth,
                                   Parity parity) const;
  std::vector<Cell> CellsOf(std::span<const double> picture, std::span<const double> corrected,
                            std::size_t width, Parity parity) const;
  double FactorOf(const Cell& cell) const;
  // Calls use(value, place, parity) for each value of a pixel and channel, with the place of its
  // cell among cells of this width.
  template <class Use>
  void ForEachValue(std::size_t cellWidth, const Use& use) const;

  int width_, height_;                       // of the picture, in pixels
  std::vector<std::vector<double>> groups_;  // mean corrections: of each pixel, three channels
  std::vector<double> shares_;               // of the samples of all groups
};

}  // namespace exphoton
