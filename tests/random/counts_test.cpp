// SPDX-License-Identifier: BSD-2-Clause
// These tests check the file that adds up several runs of the soak.
#include "tests/random/scenes/counts.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace exphoton::random_scenes {
namespace {

TEST(SoakCounts, AddUpTheScenesOfSeveralRuns) {
  SoakCounts counts = ParseCounts("");
  counts = Sum(counts, {{"energy", {100, 0}}, {"rooms", {1, 1}}});
  counts.next = 101;
  counts = ParseCounts(CountsText(counts));
  counts = Sum(counts, {{"energy", {50, 2}}});
  EXPECT_EQ(counts.next, 101U);
  EXPECT_EQ(CountsText(counts), "next 101\nenergy 150 2\nrooms 1 1\n");
}

TEST(SoakCounts, OfAnotherFileAreAnError) {
  for (const char* text : {"energy 1 0\n", "next 5\nenergy 1\n", "next 5\nenergy 1 2\n",
                           "next 5\nenergy -1 -2\n", "next 5 6\n", "next 5\nenergy 1 0 0\n"})
    EXPECT_THROW(ParseCounts(text), std::runtime_error) << text;
}

}  // namespace
}  // namespace exphoton::random_scenes
