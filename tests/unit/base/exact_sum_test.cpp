// SPDX-License-Identifier: BSD-2-Clause
// These tests check sums that do not depend on the order of their terms.
#include "core/base/exact_sum.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace exphoton {
namespace {

template <class Numbers>
double WideSum(const Numbers& numbers) {
  WideExactSum sum;
  for (const double x : numbers) sum.Add(x);
  return sum.Total();
}

TEST(WideExactSum, KeepsValuesOfAnySize) {
  for (const double size : {1e-36, 1e-20, 1e-12, 1e-3, 1., 1e9, 1e12, 1e13, 1e25, 1e36}) {
    const double x = size * 1.2345678;
    EXPECT_NEAR(WideSum(std::vector{x}) / x, 1, 1e-7) << size;
    EXPECT_NEAR(WideSum(std::vector{-x}) / x, -1, 1e-7) << size;
    EXPECT_NEAR(WideSum(std::vector<double>(1000, x)) / (1000 * x), 1, 1e-7) << size;
  }
}

TEST(WideExactSum, DoesNotDependOnTheOrder) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> exponent(-60, 60), mantissa(-1, 1);
  std::vector<double> numbers(5000);
  for (double& x : numbers) x = mantissa(random) * std::exp2(exponent(random));
  const double sum = WideSum(numbers);
  for (int i = 0; i < 5; ++i) {
    std::shuffle(numbers.begin(), numbers.end(), random);
    EXPECT_EQ(WideSum(numbers), sum);
  }
}

TEST(WideExactSum, LeavesNothingOfValuesThatCancel) {
  EXPECT_EQ(WideSum(std::vector{1e-20, 3., 1e30, -1e30, -3., -1e-20}), 0);
}

TEST(WideExactSum, BoundsInfinityAndSkipsNaN) {
  EXPECT_EQ(WideSum(std::vector{std::nan(""), 2.}), 2);
  EXPECT_TRUE(std::isfinite(WideSum(std::vector{HUGE_VAL, HUGE_VAL})));
}

}  // namespace
}  // namespace exphoton
