// SPDX-License-Identifier: BSD-2-Clause
// These tests check that PackedRadiance returns the values that were packed, including black.
#include "integrators/photon/radiance/packed_radiance.h"

#include <gtest/gtest.h>

namespace exphoton {
namespace {

TEST(PackedRadiance, KeepsRadianceCoatAndShareApart) {
  for (const Spectrum& radiance : {Spectrum(0), Spectrum(Real(.1), 2, Real(3e20))}) {
    for (const bool isCoated : {false, true}) {
      for (const Real share : PackedRadiance::kShares) {
        const PackedRadiance packed(radiance, share, isCoated);
        EXPECT_EQ(packed.Radiance(), radiance);
        EXPECT_EQ(packed.IsCoated(), isCoated);
        EXPECT_EQ(packed.GlossyShare(), share);
      }
    }
  }
}

// Rounding down could lose light for good, because a glossy share of 0 is never evaluated.
TEST(PackedRadiance, RoundsTheGlossyShareUp) {
  EXPECT_EQ(PackedRadiance(Spectrum(1), 0, false).GlossyShare(), Real(1) / 16);
  EXPECT_EQ(PackedRadiance(Spectrum(1), Real(.07), false).GlossyShare(), Real(1) / 4);
  EXPECT_EQ(PackedRadiance(Spectrum(1), Real(.3), false).GlossyShare(), Real(1) / 2);
  EXPECT_EQ(PackedRadiance(Spectrum(1), Real(.51), false).GlossyShare(), 1);
}

}  // namespace
}  // namespace exphoton
