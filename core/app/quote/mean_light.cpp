// SPDX-License-Identifier: BSD-2-Clause
#include "core/app/quote/mean_light.h"

#include <cmath>
#include <vector>

#include "core/app/dial/pilots/small_scene.h"

namespace exphoton::cli {
namespace {

constexpr std::size_t kCell = 8;  // pixels; neighbours share photons and gathers

// Returns the mean of the channels of each pixel.
std::vector<double> LightOf(const Film& film) {
  const std::vector<double> values = ValuesOf(film);
  std::vector<double> light(values.size() / 3);
  for (std::size_t i = 0; i < light.size(); ++i)
    light[i] = (values[3 * i] + values[3 * i + 1] + values[3 * i + 2]) / 3;
  return light;
}

}  // namespace

// The freedom is the number of normal values whose squares would spread like those of the cells.
MeanLight MeanOfHalves(std::span<const double> first, std::span<const double> second,
                       std::size_t width) {
  const std::size_t columns = (width + kCell - 1) / kCell, rows = first.size() / width;
  std::vector<double> differences(columns * ((rows + kCell - 1) / kCell));
  double sum = 0;
  for (std::size_t i = 0; i < first.size(); ++i) {
    sum += (first[i] + second[i]) / 2;
    differences[i / width / kCell * columns + i % width / kCell] += (first[i] - second[i]) / 2;
  }
  double squares = 0, fourthPowers = 0;
  for (const double difference : differences) {
    const double square = difference * difference;
    squares += square, fourthPowers += square * square;
  }
  MeanLight light;
  if (!(sum > 0)) return light;
  light.mean = sum / double(first.size());
  light.relativeError = std::sqrt(squares) / sum;
  if (fourthPowers > 0) light.freedom = 3 * squares * squares / fourthPowers;
  return light;
}

MeanLight MeanOfHalves(const Film& first, const Film& second) {
  return MeanOfHalves(LightOf(first), LightOf(second), std::size_t(first.Crop().Width()));
}

}  // namespace exphoton::cli
