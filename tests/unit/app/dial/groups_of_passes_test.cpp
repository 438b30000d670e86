// SPDX-License-Identifier: BSD-2-Clause
// These tests count the groups of passes that --accuracy plans.
#include <gtest/gtest.h>

#include "core/app/dial/candidate.h"
#include "core/app/dial/dial.h"

namespace exphoton::cli {
namespace {

// A candidate of 100 samples a pixel, with this number of sets of photons.
Candidate WithSets(int sets, double photonSamples) {
  Candidate candidate;
  candidate.price.samples = 100;
  candidate.price.sets = sets;
  candidate.photonSamples = photonSamples;
  candidate.hasScatter = true;
  return candidate;
}

TEST(GroupsOf, AreFewWherePhotonsAreDear) {
  EXPECT_EQ(GroupsOf(WithSets(2, 100)), 2);
  EXPECT_EQ(GroupsOf(WithSets(2, 100. / 34)), 5);  // a set takes 1/35 of the time
  EXPECT_EQ(GroupsOf(WithSets(2, 0)), 16);
}

// Groups that share one set of photons cost nothing, and pilots with scatter may be wrong.
TEST(GroupsOf, AreSomeWhereAllHaveOneSetOfPhotons) {
  EXPECT_EQ(GroupsOf(WithSets(1, 100)), 4);
  Candidate sure = WithSets(1, 100);
  sure.hasScatter = false;
  EXPECT_EQ(GroupsOf(sure), 2);
}

TEST(GroupsOf, AreLargeWhereGathersAreShared) {
  Candidate shares = WithSets(1, 0);
  shares.correctedShare = .01;
  EXPECT_EQ(GroupsOf(shares), 4);
  shares.price.samples = 12;
  EXPECT_EQ(GroupsOf(shares), 3);
  shares.price.samples = 4;
  EXPECT_EQ(GroupsOf(shares), 2);
}

}  // namespace
}  // namespace exphoton::cli
