// SPDX-License-Identifier: BSD-2-Clause
// These tests compare the statistics of runs over random scenes with closed forms and tables.
#include "tests/random/scenes/statistics.h"

#include <gtest/gtest.h>

#include <cmath>

namespace exphoton::random_scenes {
namespace {

TEST(RunStatistics, IncompleteBetaIsABinomialTail) {
  // I_p(k, n - k + 1) is the probability of at least k of n: 56/1024 for 8 of 10 at p = 1/2.
  EXPECT_NEAR(IncompleteBeta(8, 3, .5), 56 / 1024., 1e-14);
  EXPECT_NEAR(IncompleteBeta(1, 1, .3), .3, 1e-14);
  EXPECT_NEAR(IncompleteBeta(.5, .5, .25), 1 / 3., 1e-14);  // 2/pi asin(sqrt(x))
  EXPECT_EQ(IncompleteBeta(2, 3, 0), 0);
  EXPECT_EQ(IncompleteBeta(2, 3, 1), 1);
}

TEST(RunStatistics, StudentTailMatchesTables) {
  EXPECT_NEAR(StudentTail(3.4995, 7), .005, 1e-6);
  EXPECT_NEAR(StudentTail(2.0150, 5), .05, 1e-5);
  EXPECT_NEAR(StudentTail(-2.0150, 5), .95, 1e-5);
  EXPECT_NEAR(StudentTail(1, 1), .25, 1e-12);                            // Cauchy
  EXPECT_NEAR(StudentTail(4, 2), .5 * (1 - 4 / std::sqrt(18.)), 1e-12);  // closed form
}

TEST(RunStatistics, BoundOfTheFailureRateMatchesClopperAndPearson) {
  EXPECT_NEAR(LargestFailureRate(0, 200), 1 - std::pow(.05, 1 / 200.), 1e-12);
  EXPECT_NEAR(LargestFailureRate(0, 10000), 2.99528e-4, 1e-8);
  // For one failure in ten, (1 - p)^10 + 10 p (1 - p)^9 = .05.
  const double p = LargestFailureRate(1, 10);
  EXPECT_NEAR(std::pow(1 - p, 10) + 10 * p * std::pow(1 - p, 9), .05, 1e-12);
  EXPECT_NEAR(p, .394163, 1e-6);
  EXPECT_EQ(LargestFailureRate(3, 3), 1);
}

TEST(RunStatistics, BenjaminiAndHochbergRejectUpToTheLastChanceBelowTheLine) {
  // The example in section 3.2 of their paper has 15 p-values. The rule rejects four of them
  // at .05.
  const std::vector<double> chances{.0001, .0004, .0019, .0095, .0201, .0278, .0298, .0344,
                                    .0459, .3240, .4262, .5719, .6528, .7590, 1};
  EXPECT_EQ(Rejected(chances, .05), (std::vector<std::size_t>{0, 1, 2, 3}));
  EXPECT_TRUE(Rejected(std::vector<double>{.5, .04, .9}, .05).empty());
}

TEST(RunStatistics, DifferencesWithinTheMarginAreNoAlarm) {
  const Sample a{1, 1e-4, 6}, b{1.03, 1e-4, 6}, far{1.2, 1e-4, 6};
  EXPECT_EQ(PValueBeyond(a, b, .05), 1);
  EXPECT_LT(PValueBeyond(a, far, .05), 1e-5);
  EXPECT_EQ(PValueAbove(a, 1.01), 1);
  EXPECT_LT(PValueAbove(far, 1), 1e-4);
}

}  // namespace
}  // namespace exphoton::random_scenes
