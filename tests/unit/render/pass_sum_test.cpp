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

TEST(PassSum, AddsTheNoiseOfPhotonsThatAllPassesShare) {
  Film picture(kSumPixel, kSumPixel);
  PassSum sum(&picture, {.01, 100});
  sum.Add(PassOf(1.05, 2), 2, 0);
  sum.SetPhotonNoise(.008);
  EXPECT_FALSE(sum.Noise());
  sum.Add(PassOf(.95, 2), 2, 1);
  const double between = .0025 / 1.01;
  EXPECT_NEAR(*sum.Noise(), between + .008, 1e-6);
  EXPECT_FALSE(sum.Reason());
  PassesResult result;
  sum.Describe(true, &result);
  ASSERT_EQ(result.variances.size(), 3u);
  EXPECT_NEAR(double(result.variances[0]), .0025 + .008 * 1.01, 1e-5);
}

// A pixel that sharing makes brighter has the noise relative to its true level.
TEST(PassSum, IsRelativeToTheLevelsOfAnotherPicture) {
  Film picture(kSumPixel, kSumPixel), dark(kSumPixel, kSumPixel);
  PassSum sum(&picture, {}), own(&dark, {});
  sum.UseLevelsOf(own);
  for (const int group : {0, 1}) {
    sum.Add(PassOf(group ? .8 : 1.2, 2), 2, group);
    own.Add(PassOf(.3, 2), 2, group);
  }
  EXPECT_NEAR(*sum.Noise(), .04 / (.09 + .01), 1e-6);
  sum.TakeNoise(own);
  EXPECT_NEAR(sum.Levels()[0], .09, 1e-6);
}

// Groups with the same photons are one of the groups that show the noise.
TEST(PassSum, JoinsGroupsWithTheSamePhotons) {
  Film picture(kSumPixel, kSumPixel);
  PassSum sum(&picture, {.01, 100});
  sum.Add(PassOf(1.2, 2), 2, 0);
  sum.Add(PassOf(1.0, 2), 2, 1);
  sum.CorrectForSequence(.02, Trust::Full);  // the groups seem to cancel
  sum.SetPhotonNoise(.008);
  sum.JoinGroups();
  EXPECT_FALSE(sum.Noise());
  EXPECT_FALSE(sum.Reason());
  sum.Add(PassOf(.9, 4), 4, 2);  // the others have the mean 1.1
  EXPECT_NEAR(*sum.Noise(), .01 / 1.01, 1e-6);
  EXPECT_EQ(sum.Groups(), 3);
}

// The noise between the joined groups and the next one is known, also if its number is above the
// last place.
TEST(PassSum, KeepsTheGroupAfterManyJoinedOnesApart) {
  Film picture(kSumPixel, kSumPixel);
  PassSum sum(&picture, {{}, 100});
  for (int group = 0; group < PassSum::kPlaces; ++group) sum.Add(PassOf(1.1, 1), 1, group);
  sum.JoinGroups();
  sum.Add(PassOf(.9, 8), 8, PassSum::kPlaces);
  EXPECT_NEAR(*sum.Noise(), .01 / 1.01, 1e-6);
  for (int group = PassSum::kPlaces + 1; group < 3 * PassSum::kPlaces; ++group)
    sum.Add(PassOf(.9, 1), 1, group);
  EXPECT_EQ(sum.GroupSums().SamplesOf(0), PassSum::kPlaces);
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
    sum.CorrectForSequence(difference / q, Trust::Full);
    EXPECT_NEAR(*sum.Noise(), difference * q / (1 - q), 1e-9) << q;
    // A rough ratio is taken for half true.
    sum.CorrectForSequence(difference / q, Trust::Half);
    EXPECT_NEAR(*sum.Noise(), difference * std::sqrt(q / (1 - q)), 1e-9) << q;
    // More noise between the groups than within them comes from photons.
    sum.CorrectForSequence(difference / .8, Trust::Full);
    EXPECT_NEAR(*sum.Noise(), difference, 1e-9);
  }
}

}  // namespace
}  // namespace exphoton
