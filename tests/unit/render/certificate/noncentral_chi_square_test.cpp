// SPDX-License-Identifier: BSD-2-Clause
// These tests compare the approximation with exact probabilities.
#include "core/render/certificate/noncentral_chi_square.h"

#include <gtest/gtest.h>

#include <cmath>

namespace exphoton {
namespace {

double NormalTail(double z) { return std::erfc(z / std::sqrt(2.)) / 2; }

// With one degree of freedom, P(X <= x) = P(|Z + m| <= sqrt(x)) for the noncentrality m^2.
TEST(NoncentralChiSquare, AgreesWithASquaredNormalNumber) {
  for (const double x : {.5, 1., 4., 16.})
    for (const double z : {1.5, 1.96, 3.}) {
      const double bound = NoncentralityBound(x, 1, z), m = std::sqrt(bound);
      const double exact = NormalTail(m - std::sqrt(x)) - NormalTail(m + std::sqrt(x));
      EXPECT_NEAR(exact / NormalTail(z), 1, .2) << x << " " << z;
    }
}

// Without noncentrality and with two degrees of freedom, P(X <= x) = 1 - exp(-x / 2).
TEST(NoncentralChiSquare, AgreesWithAnExponentialNumber) {
  for (const double x : {.1, .5, 2., 8.})
    EXPECT_NEAR(NormalTail(-NoncentralChiSquareScore(x, 2, 0)), 1 - std::exp(-x / 2), .015) << x;
}

TEST(NoncentralChiSquare, HasNoBoundWhereTheValueIsTooSmall) {
  EXPECT_EQ(NoncentralityBound(10, 100, 3), 0);
  EXPECT_GT(NoncentralityBound(100, 100, 3), 0);
}

}  // namespace
}  // namespace exphoton
