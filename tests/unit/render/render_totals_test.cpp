// SPDX-License-Identifier: BSD-2-Clause
// These tests check the counts that the threads and passes of a render add up.
#include <gtest/gtest.h>

#include "core/render/render_totals.h"

namespace exphoton {
namespace {

TEST(RenderTotals, AddAllCountsOfAnotherThread) {
  RenderTotals first, second;
  first.cameraSamples = 10, first.nonFinite = 3, first.negative = 2;
  second.cameraSamples = 5, second.nonFinite = 4, second.negative = 1;
  first.rays.Count(RayKind::Shadow);
  second.rays.Count(RayKind::Shadow);
  first.Add(second);
  EXPECT_EQ(first.cameraSamples, 15);
  EXPECT_EQ(first.nonFinite, 7);
  EXPECT_EQ(first.negative, 3);
  EXPECT_EQ(first.rays.Total(), 2u);
}

TEST(RenderTotals, HaveTheMeanOfTheEstimatesOfSharing) {
  RenderTotals totals;
  EXPECT_FALSE(totals.MeanSharingBias());
  totals.AddSharingBias({.25, .125}, 8);
  EXPECT_EQ(totals.MeanSharingBias()->squared, .25);
  EXPECT_EQ(totals.MeanSharingBias()->standardError, .125);
  totals.AddSharingBias({1, 0}, 4);
  EXPECT_EQ(totals.MeanSharingBias()->squared, .5);
  EXPECT_EQ(totals.MeanSharingBias()->standardError, .125 * 8 / 12);
}

}  // namespace
}  // namespace exphoton
