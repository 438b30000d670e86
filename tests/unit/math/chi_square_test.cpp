// SPDX-License-Identifier: BSD-2-Clause
#include "core/math/chi_square.h"

#include <gtest/gtest.h>

#include <cmath>

namespace exphoton {
namespace {

TEST(ChiSquare, QuantileInvertsTheTail) {
  EXPECT_NEAR(ChiSquareQuantile(.025, 1), 9.8207e-4, 1e-8);
  EXPECT_NEAR(ChiSquareQuantile(.025, 2), -2 * std::log(.975), 1e-9);
  EXPECT_NEAR(ChiSquareQuantile(.025, 10), 3.246973, 1e-6);
  for (const double degrees : {1., 1.8, 30., 1000.})
    for (const double probability : {1e-6, .01, .4}) {
      const double x = ChiSquareQuantile(probability, degrees);
      EXPECT_NEAR((1 - ChiSquareTail(x, degrees)) / probability, 1, 1e-6) << degrees;
    }
}

}  // namespace
}  // namespace exphoton
