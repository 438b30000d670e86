// SPDX-License-Identifier: BSD-2-Clause
// These tests check the 8-bit code of a photon's distance.
#include "integrators/photon/maps/photon_distance.h"

#include <gtest/gtest.h>

#include <limits>

namespace exphoton {
namespace {

TEST(PhotonDistance, IsWithinFivePercent) {
  for (Real part = Real(1e-9); part < 1; part *= Real(1.01))
    ASSERT_NEAR(DecodeDistance(EncodeDistance(part)) / part, 1, .045);
}

TEST(PhotonDistance, TakesWhatIsNearerOrFartherToTheEnds) {
  EXPECT_EQ(EncodeDistance(1), 0);
  EXPECT_EQ(EncodeDistance(Real(1e30)), 0);
  EXPECT_EQ(EncodeDistance(std::numeric_limits<Real>::infinity()), 0);
  EXPECT_EQ(EncodeDistance(Real(1e-30)), 255);
  EXPECT_EQ(EncodeDistance(0), 255);
  EXPECT_EQ(DecodeDistance(0), 1);
  EXPECT_GT(DecodeDistance(255), 0);
}

}  // namespace
}  // namespace exphoton
