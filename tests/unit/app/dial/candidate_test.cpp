// SPDX-License-Identifier: BSD-2-Clause
// These tests decide whether guidedpath gets a pilot beside other integrators, and which candidates
// are rivals.
#include <gtest/gtest.h>

#include "core/app/dial/candidate.h"

namespace exphoton::cli {
namespace {

Candidate Priced(const char* integrator, double price) {
  Candidate candidate;
  candidate.integrator = integrator;
  candidate.price.seconds = price;
  return candidate;
}

TEST(GuidePilot, IsLeftOutWherePathIsFarDearer) {
  EXPECT_FALSE(MayGuidingWin({Priced("path", 16.5), Priced("exphotonmap", 1)}));
  EXPECT_TRUE(MayGuidingWin({Priced("path", 15.5), Priced("exphotonmap", 1)}));
  EXPECT_TRUE(MayGuidingWin({Priced("path", 1), Priced("exphotonmap", 100)}));
}

TEST(GuidePilot, IsNeededWherePathHasNoPrice) {
  Candidate path = Priced("path", 100);
  path.reason = "less light than others";
  EXPECT_TRUE(MayGuidingWin({path, Priced("exphotonmap", 1)}));
  EXPECT_TRUE(MayGuidingWin({Priced("exphotonmap", 1)}));
  EXPECT_TRUE(MayGuidingWin({}));
}

// Then the price of the other one says nothing.
TEST(GuidePilot, IsNeededWhereTheCheapestHasNoPrice) {
  Candidate gathered = Priced("exphotonmap", 1);
  gathered.reason = "less light than others";
  EXPECT_TRUE(MayGuidingWin({Priced("path", 100), gathered}));
}

TEST(Candidate, RivalsHaveSimilarPrices) {
  EXPECT_TRUE(Priced("path", 1).IsRivalOf(Priced("exphotonmap", 3.9)));
  EXPECT_TRUE(Priced("path", 3.9).IsRivalOf(Priced("exphotonmap", 1)));
  EXPECT_FALSE(Priced("path", 1).IsRivalOf(Priced("exphotonmap", 4.1)));
  EXPECT_FALSE(Priced("path", 4.1).IsRivalOf(Priced("exphotonmap", 1)));
}

TEST(Candidate, OnlyCandidatesWithPricesAreRivals) {
  Candidate dark = Priced("path", 1);
  dark.reason = "less light than others";
  EXPECT_FALSE(dark.IsRivalOf(Priced("exphotonmap", 1)));
  EXPECT_FALSE(Priced("exphotonmap", 1).IsRivalOf(dark));
}

}  // namespace
}  // namespace exphoton::cli
