// SPDX-License-Identifier: BSD-2-Clause
#include "core/imaging/film/local_square.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/imaging/metrics/metrics.h"

namespace exphoton {
namespace {

constexpr std::ptrdiff_t kReach = 2;       // pixels
constexpr double kDeviations = 3;          // at most, between a value and a neighbour of its kind
constexpr double kDeviationsOfOthers = 2;  // at least, from the level to a value that replaces it

// Sums over the neighbours of a value that differ from it by no more than their noise.
struct Kind {
  double count = 0, values = 0, squares = 0, variances = 0;

  void Add(double value, double variance) {
    ++count, values += value, squares += value * value, variances += variance;
  }
  double Mean() const { return values / count; }
  double MeanVariance() const { return variances / count; }
  double VarianceOfMean() const { return variances / (count * count); }
  // Returns the variance of the true values: the spread beyond the noise.
  double Spread() const {
    if (count < 2) return 0;
    const double spread = (squares - values * values / count) / (count - 1);
    return std::max(spread - variances / count, 0.);
  }
};

// Returns the square s for which 1 / (s + .01) estimates 1 / (r^2 + .01), where r is the expected
// value of a level with this variance. To second order, the inverse of level^2 + .01 is too large
// by a share of variance (3 level^2 - .01) / (level^2 + .01)^2. The first terms of exp(share)
// divide it, so that the result is positive.
double UnbiasedSquare(double level, double variance) {
  const double square = level * level, sum = square + kRelMseOffset;
  const double share = std::max(variance * (3 * square - kRelMseOffset) / (sum * sum), 0.);
  return square + sum * share * (1 + share / 2);
}

// The picture, one channel at a time.
class Levels {
 public:
  Levels(const std::vector<float>& means, const std::vector<float>& variances, std::size_t width,
         const std::vector<float>& deviations)
      : means_(means),
        variances_(variances),
        deviations_(deviations),
        columns_(std::ptrdiff_t(width)),
        rows_(std::ptrdiff_t(means.size() / 3) / columns_) {}

  double SquareAt(std::ptrdiff_t x, std::ptrdiff_t y, std::ptrdiff_t channel) const {
    const std::size_t at = Index(x, y, channel);
    const double mean = double(means_[at]), variance = double(variances_[at]);
    const bool isNoisy = variance > 0 && variance < std::numeric_limits<double>::infinity();
    if (!isNoisy) return mean * mean;
    const Kind others = OthersOfKind(x, y, channel);
    // Without others, the level is the value. Its convexity and its correlation with the variance
    // change the quotient in opposite directions, so neither is removed.
    if (others.count == 0) return mean * mean;
    Kind kind = others;
    kind.Add(mean, variance);
    // The true value is normally distributed around the mean of its kind. The value itself is not
    // in this mean, because its error depends on the error of its variance.
    const double spread = kind.Spread(), own = spread / (spread + variance), rest = 1 - own;
    const double square =
        UnbiasedSquare(own * mean + rest * others.Mean(),
                       own * own * variance + rest * rest * others.VarianceOfMean());
    // Several groups agree that the value is brighter than its kind, so it is a kind of its own.
    const double lower = mean - Deviations(at) * std::sqrt(variance);
    const double chance = kDeviationsOfOthers * std::sqrt(others.MeanVariance());
    return lower > std::sqrt(square) + chance ? lower * lower : square;
  }

 private:
  double Deviations(std::size_t at) const {
    return deviations_.empty() ? 1 : double(deviations_[at / 3]);
  }
  std::size_t Index(std::ptrdiff_t x, std::ptrdiff_t y, std::ptrdiff_t channel) const {
    return std::size_t(3 * (y * columns_ + x) + channel);
  }

  Kind OthersOfKind(std::ptrdiff_t x, std::ptrdiff_t y, std::ptrdiff_t channel) const {
    const std::size_t at = Index(x, y, channel);
    const double mean = double(means_[at]), variance = double(variances_[at]);
    Kind others;
    for (std::ptrdiff_t v = std::max(y - kReach, std::ptrdiff_t(0));
         v <= std::min(y + kReach, rows_ - 1); ++v) {
      for (std::ptrdiff_t u = std::max(x - kReach, std::ptrdiff_t(0));
           u <= std::min(x + kReach, columns_ - 1); ++u) {
        const std::size_t other = Index(u, v, channel);
        if (other == at) continue;
        const double difference = double(means_[other]) - mean;
        const double noise = variance + double(variances_[other]);
        if (noise < std::numeric_limits<double>::infinity() &&
            difference * difference <= kDeviations * kDeviations * noise)
          others.Add(double(means_[other]), double(variances_[other]));
      }
    }
    return others;
  }

  const std::vector<float>&means_, &variances_, &deviations_;
  std::ptrdiff_t columns_, rows_;
};

}  // namespace

std::vector<double> SquaredLevels(const std::vector<float>& means,
                                  const std::vector<float>& variances, std::size_t width,
                                  const std::vector<float>& deviations) {
  const Levels levels(means, variances, width, deviations);
  std::vector<double> squares(means.size());
  for (std::size_t i = 0; i < squares.size(); ++i) {
    const std::size_t pixel = i / 3;
    squares[i] = levels.SquareAt(std::ptrdiff_t(pixel % width), std::ptrdiff_t(pixel / width),
                                 std::ptrdiff_t(i % 3));
  }
  return squares;
}

}  // namespace exphoton
