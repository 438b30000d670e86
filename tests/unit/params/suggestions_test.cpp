// SPDX-License-Identifier: BSD-2-Clause
// These tests check distances between words and the names that messages propose.
#include "core/params/suggestions.h"

#include <gtest/gtest.h>

namespace exphoton {
namespace {

using Words = std::vector<std::string>;

TEST(Suggestions, TheDistanceCountsChangesOfALetter) {
  EXPECT_EQ(EditDistance("sphere", "sphere"), 0);
  EXPECT_EQ(EditDistance("Sphere", "sPHERE"), 0);
  EXPECT_EQ(EditDistance("sphre", "sphere"), 1);
  EXPECT_EQ(EditDistance("sphhere", "sphere"), 1);
  EXPECT_EQ(EditDistance("spzere", "sphere"), 1);
  EXPECT_EQ(EditDistance("shpere", "sphere"), 1);  // neighbours in the wrong order
  EXPECT_EQ(EditDistance("", "disk"), 4);
  EXPECT_EQ(EditDistance("disk", ""), 4);
  EXPECT_EQ(EditDistance("kitten", "sitting"), 3);
}

TEST(Suggestions, OfEquallyNearNamesTheFirstIsProposed) {
  EXPECT_EQ(Nearest("Kx", Words{"Kd", "Ks", "Kr"}), "Kd");
  EXPECT_EQ(Nearest("cane", Words{"mirror", "cone", "cube", "lane"}), "cone");
}

TEST(Suggestions, ANearerNameIsProposedWhereverItStands) {
  EXPECT_EQ(Nearest("colour", Words{"column", "color"}), "color");
  EXPECT_EQ(Nearest("colour", Words{"color", "column"}), "color");
}

TEST(Suggestions, AThirdOfTheLettersMayDiffer) {
  EXPECT_EQ(Nearest("abcdef", Words{"abcdxy"}), "abcdxy");
  EXPECT_EQ(Nearest("abcdef", Words{"abcxyz"}), std::nullopt);
  EXPECT_EQ(Nearest("ab", Words{"ax"}), "ax");  // one difference always
  EXPECT_EQ(Nearest("ab", Words{"xy"}), std::nullopt);
  EXPECT_EQ(Nearest(std::string(65, 'a'), Words{std::string(65, 'a')}), std::nullopt);
}

TEST(Suggestions, NothingNearGivesNoText) {
  EXPECT_EQ(DidYouMean("sphre", Words{"disk", "sphere"}), "did you mean \"sphere\"?");
  EXPECT_EQ(DidYouMean("teapot", Words{"disk", "sphere"}), "");
}

}  // namespace
}  // namespace exphoton
