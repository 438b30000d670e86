// SPDX-License-Identifier: BSD-2-Clause
// Check is one check of a plugin: a figure and its limit. `exphoton check-plugin` prints a line for
// each.
#pragma once

#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

namespace exphoton {

struct Check {
  std::string name;  // "energy"
  double figure = 0, limit = 0;
  bool isAtLeast = false;  // whether the figure must be at least the limit, instead of at most
  std::string meaning;     // of the figure

  bool IsPassed() const {  // false for NaN
    return isAtLeast ? figure >= limit : figure <= limit;
  }
};

// Checks collects the checks of one plugin.
struct Checks {
  std::vector<Check> list;
  std::vector<std::string> notes;  // about checks that do not apply

  void AtMost(const std::string& name, double figure, double limit, const std::string& meaning) {
    list.push_back({name, figure, limit, false, meaning});
  }
  void AtLeast(const std::string& name, double figure, double limit, const std::string& meaning) {
    list.push_back({name, figure, limit, true, meaning});
  }
};

// The rate of false alarms of all chi-square tests of a plugin together. The random numbers follow
// from the seed, so a plugin that passes once passes again.
inline constexpr double kFalseAlarms = 1e-3;

// The mean of estimates from several seeds, with its standard error.
struct MeanOfSeeds {
  static constexpr int kSeeds = 8;
  double mean = 0, error = 0;

  // `estimate(seed)` is called for different seeds.
  template <class Estimate>
  static MeanOfSeeds Of(std::uint64_t seed, Estimate&& estimate) {
    double sum = 0, squares = 0;
    for (int i = 0; i < kSeeds; ++i) {
      const double x = estimate(seed * kSeeds + std::uint64_t(i));
      sum += x;
      squares += x * x;
    }
    const double mean = sum / kSeeds;
    const double variance = std::max(squares / kSeeds - mean * mean, 0.) / (kSeeds - 1);
    return {mean, std::sqrt(variance)};
  }
};

}  // namespace exphoton
