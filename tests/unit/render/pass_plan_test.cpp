// SPDX-License-Identifier: BSD-2-Clause
#include "core/render/passes/pass_plan.h"

#include <gtest/gtest.h>

namespace exphoton {
namespace {

// 16 samples are rendered in the first group. With .1 s a sample and 2 s for preprocessing, the
// second group of a limit of 10 s gets what is left after its own preprocessing.
TEST(PassPlan, ANewGroupFitsIntoTheTimeAfterItsPreprocessing) {
  PassPlan plan({.targetError = {}, .timeLimit = 10, .maxSamples = 1000});
  plan.Take({.isNewGroup = true, .size = 16});
  const auto next = [&](double elapsed) {
    return plan.Next({.samples = 16,
                      .noise = {},
                      .enough = {},
                      .elapsed = elapsed,
                      .preprocess = 2,
                      .sample = .1});
  };
  EXPECT_TRUE(next(7.04).isNewGroup);
  EXPECT_EQ(next(7.04).size, 4);  // .96 s are left; the second group has two halves
  EXPECT_EQ(next(7.54).size, 4);  // .46 s
  EXPECT_EQ(next(7.84).size, 1);  // .16 s
  EXPECT_EQ(next(7.94).size, 0);  // .06 s: no sample
}

// A pass with a given number of samples takes 1.6 s for them and 2 s for its preprocessing.
TEST(PassPlan, APassOfGivenSizeFitsIntoTheTime) {
  const auto next = [](std::optional<double> timeLimit, double elapsed, std::int64_t samples) {
    return PassPlan(
               {.targetError = {}, .timeLimit = timeLimit, .maxSamples = 1000, .passSamples = 16})
        .Next({.samples = samples,
               .noise = {},
               .enough = {},
               .elapsed = elapsed,
               .preprocess = 2,
               .sample = .1});
  };
  EXPECT_EQ(next(10, 6.3, 16).size, 16);
  EXPECT_TRUE(next(10, 6.3, 16).isNewGroup);
  EXPECT_EQ(next(10, 6.5, 16).size, 0);
  EXPECT_EQ(next(10, 12, 0).size, 16);  // the first pass is always rendered
  EXPECT_EQ(next({}, 12, 16).size, 16);
}

}  // namespace
}  // namespace exphoton
