// SPDX-License-Identifier: BSD-2-Clause
// These tests add passes of known pixels and check the noise and the stopping rule.
#include "core/render/passes/pass_sum.h"

#include <gtest/gtest.h>

#include <cmath>

namespace exphoton {
namespace {

constexpr PixelBounds kSumPixel{0, 0, 1, 1};

Film PassOf(double value, int samples) {
  Film pass(kSumPixel, kSumPixel);
  for (int i = 0; i < samples; ++i) pass.AddSample({0, 0}, Spectrum(Real(value)), 1, 1);
  return pass;
}

TEST(PassSum, StopsAtTheTargetOrAtTheLimit) {
  Film picture(kSumPixel, kSumPixel);
  PassSum sum(&picture, {.001, 6});
  sum.Add(PassOf(1.2, 2), 2, 0);
  EXPECT_FALSE(sum.Noise());
  EXPECT_FALSE(sum.Reason());
  sum.Add(PassOf(.8, 2), 2, 1);
  EXPECT_NEAR(*sum.Noise(), .04 / 1.01, 1e-6);
  EXPECT_FALSE(sum.Reason());
  sum.Add(PassOf(1, 2), 2, 2);
  EXPECT_EQ(sum.Reason(), StopReason::Samples);
  EXPECT_EQ(sum.Groups(), 3);
  EXPECT_NEAR(picture.MeanOf({0, 0})[0], 1, 1e-6);

  Film other(kSumPixel, kSumPixel);
  PassSum reached(&other, {.05, 6});
  reached.Add(PassOf(1.2, 2), 2, 0);
  reached.Add(PassOf(.8, 2), 2, 1);
  EXPECT_EQ(reached.Reason(), StopReason::TargetError);
}

// The error of n samples is n^-s, and q = 2^-s. The error of the mean of two groups is q times
// the error of one group, and their difference suggests 1 - q.
TEST(PassSum, KnowsThatSuccessiveHalvesCancel) {
  for (const double q : {.35, .42, .5}) {
    Film picture(kSumPixel, kSumPixel);
    PassSum sum(&picture, {{}, 100});
    sum.Add(PassOf(1.1, 4), 4, 0);
    sum.Add(PassOf(.9, 4), 4, 1);
    const double difference = *sum.Noise();
    sum.CorrectForSequence(difference / q, 8);
    EXPECT_NEAR(*sum.Noise(), difference * q / (1 - q), 1e-9) << q;
    // A rough ratio is taken for half true.
    sum.CorrectForSequence(difference / q, 4);
    EXPECT_NEAR(*sum.Noise(), difference * std::sqrt(q / (1 - q)), 1e-9) << q;
    // More noise between the groups than within them comes from photons.
    sum.CorrectForSequence(difference / .8, 8);
    EXPECT_NEAR(*sum.Noise(), difference, 1e-9);
  }
}

}  // namespace
}  // namespace exphoton
