// SPDX-License-Identifier: BSD-2-Clause
// PairProducts are the inner products of the pictures of several seeds. The mean over pairs of
// different seeds estimates the product of two expected pictures without their noise. Jackknife
// gives standard errors of numbers that are computed from seeds.
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include "core/app/analysis/separation.h"

namespace exphoton::cli {

// Numbers of a picture, for example three channels per pixel, row by row.
using PictureValues = std::vector<double>;

class PairProducts {
 public:
  // Picture i of `first` and picture i of `second` are from the same seed. All pictures have the
  // same size.
  PairProducts(std::span<const PictureValues> first, std::span<const PictureValues> second);

  // The mean product over the pairs of the same seed. `kept` lists the seeds that count.
  double OfSameSeed(std::span<const std::size_t> kept) const;
  // The mean product over all pairs of different seeds; there must be at least two.
  double OfOtherSeeds(std::span<const std::size_t> kept) const;

 private:
  std::size_t count_;
  std::vector<double> products_;  // row by row
};

// Returns numbers that are computed from the seeds in `kept`.
using SeedStatistics = std::function<std::vector<double>(std::span<const std::size_t> kept)>;

// Returns the statistics of all seeds with their standard errors by the jackknife, which are
// unknown for fewer than three seeds.
std::vector<study::Measured> Jackknife(std::size_t seeds, const SeedStatistics& statistics);

}  // namespace exphoton::cli
