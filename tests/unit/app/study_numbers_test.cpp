// SPDX-License-Identifier: BSD-2-Clause
// These tests check how a study writes its numbers.
#include "core/app/analysis/numbers.h"

#include <gtest/gtest.h>

namespace exphoton::study {
namespace {

TEST(StudyNumbers, ShortNumbersKeepTheirDigits) {
  EXPECT_EQ(ShortNumber(.0123), "0.012");
  EXPECT_EQ(ShortNumber(7), "7");
  EXPECT_EQ(ShortNumber(1234), "1234");
  EXPECT_EQ(ShortNumber(.1), "0.1");
  EXPECT_EQ(ShortNumber(0), "0");
  EXPECT_EQ(ShortNumber(-.5), "−0.5");
  EXPECT_EQ(ShortNumber(kUnknown), "–");
  EXPECT_EQ(ShortNumber(.01264, 3), "0.0126");
  EXPECT_EQ(ShortNumber(.001), "0.001");
}

TEST(StudyNumbers, SmallAndLargeNumbersHavePowersOfTen) {
  EXPECT_EQ(ShortNumber(.00005), "5×10⁻⁵");
  EXPECT_EQ(ShortNumber(.000123), "1.2×10⁻⁴");
  EXPECT_EQ(ShortNumber(1e5), "1×10⁵");
  EXPECT_EQ(ShortNumber(-2.5e12), "−2.5×10¹²");
}

TEST(StudyNumbers, SecondsHaveUnits) {
  EXPECT_EQ(SecondsText(9.83), "9.8 s");
  EXPECT_EQ(SecondsText(9.96), "10 s");
  EXPECT_EQ(SecondsText(640), "10.7 min");
  EXPECT_EQ(SecondsText(99), "99 s");
  EXPECT_EQ(SecondsText(99.9), "1.7 min");
  EXPECT_EQ(SecondsText(5950), "1.7 h");
}

TEST(StudyNumbers, CountsAreShort) {
  EXPECT_EQ(CountText(9999), "9999");
  EXPECT_EQ(CountText(10000), "10 k");
  EXPECT_EQ(CountText(123456), "123 k");
  EXPECT_EQ(CountText(1e6), "1 M");
}

TEST(StudyNumbers, AValueAndItsErrorEndAtTheSameDigit) {
  EXPECT_EQ(MeasuredText({.2, .005}), "0.200 ± 0.005");
  EXPECT_EQ(MeasuredText({1, .05}), "1.00 ± 0.05");
  EXPECT_EQ(MeasuredText({2, .26}), "2.0 ± 0.3");
  EXPECT_EQ(MeasuredText({412.34, 3}), "412 ± 3");
  EXPECT_EQ(MeasuredText({1234, 56}), "1230 ± 60");
  EXPECT_EQ(MeasuredText({-.031, .002}), "−0.031 ± 0.002");
  EXPECT_EQ(MeasuredText({-.0001, .02}), "0.00 ± 0.02");
  EXPECT_EQ(MeasuredText({.01, .5}), "0.0 ± 0.5");
}

TEST(StudyNumbers, AnErrorThatRoundsUpGainsADigit) {
  EXPECT_EQ(MeasuredText({5, .0961}), "5.0 ± 0.1");
  EXPECT_EQ(MeasuredText({50, 9.7}), "50 ± 10");
}

TEST(StudyNumbers, ValuesHaveAtMostFiveDigits) {
  EXPECT_EQ(MeasuredText({7, 1e-9}), "7.0000 ± 0");
  EXPECT_EQ(MeasuredText({7, 0}), "7 ± 0");
}

TEST(StudyNumbers, UnknownErrorsAreLeftOut) {
  EXPECT_EQ(MeasuredText({2, kUnknown}), "2");
  EXPECT_EQ(MeasuredText({}), "–");
  EXPECT_EQ(ChangeText({.32, kUnknown}), "−68 %");
  EXPECT_EQ(ChangeText({}), "–");
  EXPECT_EQ(SignedSecondsText({}), "–");
}

TEST(StudyNumbers, ChangesHaveASignUnlessTheyAreZero) {
  EXPECT_EQ(ChangeText({.32, .03}), "−68 ± 3 %");
  EXPECT_EQ(ChangeText({1.5, .02}), "+50 ± 2 %");
  EXPECT_EQ(ChangeText({1.001, .02}), "0 ± 2 %");
  EXPECT_EQ(ChangeText({.999, .02}), "0 ± 2 %");
  EXPECT_EQ(SignedSecondsText({1.52, .1}), "+1.5 ± 0.1 s");
  EXPECT_EQ(SignedSecondsText({-.4, .04}), "−0.40 ± 0.04 s");
}

TEST(StudyNumbers, SharesAreFractionsOrPerCent) {
  EXPECT_EQ(ShareText(1 / 9.2), "1/9");
  EXPECT_EQ(ShareText(1 / 43.4), "1/43");
  EXPECT_EQ(ShareText(1 / 123.), "1/120");
  EXPECT_EQ(ShareText(.25), "25 %");
  EXPECT_EQ(ShareText(.7), "70 %");
  EXPECT_EQ(ShareText(kUnknown), "–");
  EXPECT_EQ(ShareText(0), "0");
  EXPECT_EQ(ShareText(-.5), "−0.5");
}

}  // namespace
}  // namespace exphoton::study
