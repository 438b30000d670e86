// SPDX-License-Identifier: BSD-2-Clause
// These tests store powers with signs, and the ratios of signed estimates.
#include "integrators/photon/maps/signed_power.h"

#include <gtest/gtest.h>

#include "integrators/photon/radiance/packed_ratios.h"

namespace exphoton {
namespace {

TEST(SignedPower, HoldsThePowerAndTheSign) {
  for (const Spectrum power : {Spectrum{1, 2, 3}, Spectrum{0, 2, 3}, Spectrum{5, 0, 0}}) {
    for (const bool isNegative : {false, true}) {
      const SignedPower packed(power, isNegative);
      EXPECT_EQ(packed.Power(), power);
      EXPECT_EQ(packed.Sign(), isNegative ? -1 : 1);
    }
  }
}

TEST(PackedRatios, HoldPartsToAQuarterOfAPercent) {
  const Spectrum whole{1, 20, 300};
  const Spectrum part{Real(.37), Real(-19.9), 0};
  const Spectrum found = PackedRatios(part, whole).PartOf(whole);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(found[c], part[c], whole[c] / 250) << c;
  EXPECT_EQ(PackedRatios(whole, whole).PartOf(whole), whole);
}

TEST(PackedRatios, OfNothingAreNothing) {
  EXPECT_TRUE(PackedRatios({1, 0, 0}, {}).PartOf({1, 1, 1}).IsBlack());
}

}  // namespace
}  // namespace exphoton
