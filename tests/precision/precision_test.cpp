// SPDX-License-Identifier: BSD-2-Clause
// Errors of formulas must shrink with the precision. One that does not shrink is an error of the
// formula or of a constant, not of rounding. Results in long double serve as the truth.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <random>

#include "tests/precision/kernels/kernels.h"

namespace precision {
namespace {

constexpr int kInputs = 2000;
constexpr long double kLeast = 1e-3L;  // smaller values have their absolute error over this

struct Errors {
  long double inFloat = 0, inDouble = 0;  // means of the relative errors
};

// By the name of the value. The median of three groups would hide rare failures, so these are
// means.
const std::map<std::string, Errors>& MeanErrors() {
  static const std::map<std::string, Errors> errors = [] {
    std::map<std::string, Errors> sums;
    std::mt19937 random(1);
    for (int i = 0; i < kInputs; ++i) {
      double u[8];
      for (double& each : u) each = std::ldexp(double(random() >> 8), -24);
      const auto inFloat = ComputeInFloat(u), inDouble = ComputeInDouble(u);
      const auto truth = ComputeInLongDouble(u);
      for (std::size_t k = 0; k < truth.size(); ++k) {
        const long double scale = std::max(std::abs(truth[k].value), kLeast) * kInputs;
        Errors& each = sums[truth[k].name];
        each.inFloat += std::abs(inFloat[k].value - truth[k].value) / scale;
        each.inDouble += std::abs(inDouble[k].value - truth[k].value) / scale;
      }
    }
    return sums;
  }();
  return errors;
}

// A rounding of double is 2^-29 of a rounding of float.
TEST(ThreePrecisions, ErrorsShrinkByTheRatioOfTheRoundings) {
  ASSERT_GT(MeanErrors().size(), 40u);
  for (const auto& [name, error] : MeanErrors()) {
    EXPECT_LT(error.inDouble, std::ldexp(std::max(error.inFloat, 0x1p-25L), -29 + 3)) << name;
    RecordProperty(name, std::to_string(double(error.inFloat)));
  }
}

TEST(ThreePrecisions, FloatLosesAtMostTwoDigitsOnAverage) {
  for (const auto& [name, error] : MeanErrors()) EXPECT_LT(error.inFloat, 100 * 0x1p-23L) << name;
}

}  // namespace
}  // namespace precision
