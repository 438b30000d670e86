// SPDX-License-Identifier: BSD-2-Clause
// SpreadOf sums in double precision, pixel by pixel.
#include "tests/rounding/measure/spread.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace exphoton::rounding {
namespace {

constexpr double kEpsilon = 0x1p-23;

double MeanOf(std::span<const double> values) {
  double sum = 0;
  for (const double value : values) sum += value;
  return sum / double(values.size());
}

// Returns the standard deviation over the scale; 0 if all values are equal.
double RelativeSpread(std::span<const double> values, double scale) {
  const double mean = MeanOf(values);
  double squares = 0;
  for (const double value : values) squares += (value - mean) * (value - mean);
  return squares == 0 ? 0 : std::sqrt(squares / double(values.size() - 1)) / scale;
}

}  // namespace

double DigitsLost(double relativeSpread) {
  return std::max(0., std::log10(std::max(relativeSpread, kEpsilon) / kEpsilon));
}

double DigitsLost(std::span<const double> values, double scale) {
  return DigitsLost(RelativeSpread(values, scale));
}

Spread SpreadOf(std::span<const Image> pictures) {
  if (pictures.size() < 2) throw std::invalid_argument("a spread needs two pictures");
  const Image& first = pictures.front();
  const int count = int(pictures.size());
  std::vector<double> means(pictures.size()), values(pictures.size()), spreads;
  for (int i = 0; i < count; ++i) {
    for (int y = 0; y < first.Height(); ++y)
      for (int x = 0; x < first.Width(); ++x)
        for (int channel = 0; channel < 3; ++channel)
          means[std::size_t(i)] += double(pictures[std::size_t(i)].At(x, y, channel));
    means[std::size_t(i)] /= 3. * first.Width() * first.Height();
  }
  Spread spread;
  const double mean = std::abs(MeanOf(means));
  spread.mean = DigitsLost(means, mean);
  for (int y = 0; y < first.Height(); ++y) {
    for (int x = 0; x < first.Width(); ++x) {
      double most = 0;
      for (int channel = 0; channel < 3; ++channel) {
        for (int i = 0; i < count; ++i)
          values[std::size_t(i)] = double(pictures[std::size_t(i)].At(x, y, channel));
        most = std::max(most, RelativeSpread(values, std::abs(MeanOf(values)) + .01 * mean));
      }
      spreads.push_back(most);
    }
  }
  std::sort(spreads.begin(), spreads.end());
  spread.median = DigitsLost(spreads[spreads.size() / 2]);
  spread.worst = DigitsLost(spreads.back());
  spread.decided =
      double(spreads.end() - std::upper_bound(spreads.begin(), spreads.end(), kDecided)) /
      double(spreads.size());
  return spread;
}

}  // namespace exphoton::rounding
