// SPDX-License-Identifier: BSD-2-Clause
#include "core/app/budget/pair_products.h"

#include <cmath>
#include <numeric>

namespace exphoton::cli {

PairProducts::PairProducts(std::span<const PictureValues> first,
                           std::span<const PictureValues> second)
    : count_(first.size()), products_(count_ * count_) {
  for (std::size_t i = 0; i < count_; ++i)
    for (std::size_t j = 0; j < count_; ++j)
      products_[i * count_ + j] =
          std::inner_product(first[i].begin(), first[i].end(), second[j].begin(), 0.);
}

double PairProducts::OfSameSeed(std::span<const std::size_t> kept) const {
  double sum = 0;
  for (const std::size_t i : kept) sum += products_[i * count_ + i];
  return sum / double(kept.size());
}

double PairProducts::OfOtherSeeds(std::span<const std::size_t> kept) const {
  double sum = 0;
  for (const std::size_t i : kept)
    for (const std::size_t j : kept)
      if (i != j) sum += products_[i * count_ + j];
  return sum / (double(kept.size()) * double(kept.size() - 1));
}

std::vector<study::Measured> Jackknife(std::size_t seeds, const SeedStatistics& statistics) {
  std::vector<std::size_t> all(seeds);
  std::iota(all.begin(), all.end(), std::size_t(0));
  std::vector<study::Measured> results;
  for (const double value : statistics(all)) results.push_back({value, study::kUnknown});
  if (seeds < 3) return results;
  std::vector<std::vector<double>> without;
  for (std::size_t left = 0; left < seeds; ++left) {
    std::vector<std::size_t> kept = all;
    kept.erase(kept.begin() + std::ptrdiff_t(left));
    without.push_back(statistics(kept));
  }
  const auto count = double(seeds);
  for (std::size_t k = 0; k < results.size(); ++k) {
    double mean = 0, squares = 0;
    for (const std::vector<double>& values : without) mean += values[k] / count;
    for (const std::vector<double>& values : without)
      squares += (values[k] - mean) * (values[k] - mean);
    results[k].error = std::sqrt(squares * (count - 1) / count);
  }
  return results;
}

}  // namespace exphoton::cli
