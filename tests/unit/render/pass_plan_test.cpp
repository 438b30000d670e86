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

// The groups after the second one have at least half of all samples, at most 8, and then at least
// an eighth of them: they shoot photons again.
TEST(PassPlan, LaterGroupsAreNotSmall) {
  const auto next = [](std::int64_t samples, bool sharesGathers = false) {
    PassPlan plan({.targetError = 1e-3,
                   .timeLimit = {},
                   .maxSamples = 100000,
                   .sharesGathers = sharesGathers});
    for (const bool isNewGroup : {true, false, true, false})
      plan.Take({.isNewGroup = isNewGroup, .size = samples / 4});
    return plan.Next({.samples = samples, .noise = 1.001e-3, .enough = double(samples)});
  };
  EXPECT_TRUE(next(4).isNewGroup);
  EXPECT_EQ(next(4).size, 2);
  EXPECT_EQ(next(8).size, 4);
  EXPECT_EQ(next(16).size, 8);
  EXPECT_EQ(next(64).size, 8);
  EXPECT_EQ(next(256).size, 32);
  EXPECT_EQ(next(4, true).size, 4);
  EXPECT_EQ(next(8, true).size, 4);
  EXPECT_EQ(next(16, true).size, 8);
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

// The first two groups are as large as the dial says. Later ones fill up what is missing, but they
// have at least this size and a quarter of the samples so far, and at most all of them.
TEST(PassPlan, GroupsForAnAccuracyFollowWhatIsNeeded) {
  PassPlan plan({.targetError = {}, .timeLimit = {}, .maxSamples = 1000, .firstSamples = 32});
  const auto size = [&](std::int64_t samples, double needed) {
    const PassPlan::Step step =
        plan.Next({.samples = samples, .noise = {}, .enough = {}, .needed = needed});
    EXPECT_TRUE(step.isNewGroup);
    return step.size;
  };
  EXPECT_EQ(size(0, 0), 32);
  plan.Take({.isNewGroup = true, .size = 32});
  EXPECT_EQ(size(32, 0), 32);
  plan.Take({.isNewGroup = true, .size = 32});
  EXPECT_EQ(size(64, 65), 32);
  EXPECT_EQ(size(64, 90), 32);
  EXPECT_EQ(size(64, 1e9), 64);
  EXPECT_EQ(size(96, 1e9), 32);  // samples 96 to 160 are no good range of a sequence
  EXPECT_EQ(size(256, 257), 64);
  EXPECT_EQ(size(980, 1e9), 20);
}

// Where photons are dear, the last group takes more passes, up to twice the size of the first one.
TEST(PassPlan, DearPhotonsServeMorePassesForAnAccuracy) {
  for (const double photons : {0., 3., 100.}) {
    PassPlan plan({.targetError = {},
                   .timeLimit = {},
                   .maxSamples = 1000,
                   .firstSamples = 8,
                   .photonSamples = photons});
    const bool isDear = photons > 2;
    std::int64_t samples = 0;
    for (const bool isNew : {true, true, !isDear, true, !isDear}) {
      const PassPlan::Step step =
          plan.Next({.samples = samples, .noise = {}, .enough = {}, .needed = double(samples) + 5});
      EXPECT_EQ(step.isNewGroup, isNew) << photons << " " << samples;
      EXPECT_EQ(step.size, 8) << photons << " " << samples;
      plan.Take(step);
      samples += step.size;
    }
    EXPECT_EQ(plan.Groups(), isDear ? 3 : 5);
  }
}

// A render that needs far more samples than its first groups have reaches them in few passes: dear
// photons once held each pass at the size of the first one.
TEST(PassPlan, DearPhotonsDoNotKeepPassesSmall) {
  for (const double missing : {1e9, 1.}) {
    PassPlan plan({.targetError = {},
                   .timeLimit = {},
                   .maxSamples = 1024,
                   .firstSamples = 4,
                   .photonSamples = 100});
    std::int64_t samples = 0;
    int passes = 0;
    for (; samples < 1024; ++passes) {
      const PassPlan::Step step = plan.Next(
          {.samples = samples, .noise = {}, .enough = {}, .needed = double(samples) + missing});
      plan.Take(step);
      samples += step.size;
    }
    EXPECT_LE(passes, missing > 1 ? 12 : 30);
  }
}

TEST(PassPlan, PhotonsThatAreKeptAreNotDear) {
  PassPlan plan({.targetError = {},
                 .timeLimit = {},
                 .maxSamples = 1000,
                 .firstSamples = 8,
                 .photonSamples = 100});
  for (int pass = 0; pass < 4; ++pass) {
    const PassPlan::Step step = plan.Next({.samples = 8 * pass,
                                           .noise = {},
                                           .enough = {},
                                           .needed = 8. * pass + 5,
                                           .keepsPhotons = true});
    EXPECT_TRUE(step.isNewGroup) << pass;
    plan.Take(step);
  }
}

TEST(PassPlan, AGroupForAnAccuracyFitsIntoTheTime) {
  PassPlan plan({.targetError = {}, .timeLimit = 10, .maxSamples = 1000, .firstSamples = 16});
  const auto size = [&](double elapsed, std::int64_t samples) {
    return plan
        .Next({.samples = samples,
               .noise = {},
               .enough = {},
               .elapsed = elapsed,
               .preprocess = 2,
               .sample = .1})
        .size;
  };
  EXPECT_EQ(size(20, 0), 16);
  EXPECT_EQ(size(6, 16), 16);   // 2 s are left after the preprocessing
  EXPECT_EQ(size(7.1, 16), 8);  // .9 s
  EXPECT_EQ(size(8, 16), 0);
}

}  // namespace
}  // namespace exphoton
