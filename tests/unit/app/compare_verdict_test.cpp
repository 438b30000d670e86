// SPDX-License-Identifier: BSD-2-Clause
// These tests check which limit of `exphoton compare` a difference breaks.
#include "core/app/commands/compare_verdict.h"

#include <gtest/gtest.h>

namespace exphoton::cli {
namespace {

// A few bright dots are in the error, and the trimmed error leaves them out.
TEST(CompareVerdict, OfFewBrightDotsIsBasedOnAllPixels) {
  Comparison comparison;
  comparison.difference.relMse = .5;
  comparison.difference.trimmedRelMse = .01;
  CompareLimits limits;
  limits.maxRelMse = .1;
  EXPECT_FALSE(Judge(comparison, limits).isPass);
  EXPECT_EQ(Judge(comparison, limits).text, "FAIL: relMSE 0.5 > 0.1");
  limits.maxRelMse = .5;
  EXPECT_TRUE(Judge(comparison, limits).isPass);
}

}  // namespace
}  // namespace exphoton::cli
