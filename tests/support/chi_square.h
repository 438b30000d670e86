// SPDX-License-Identifier: BSD-2-Clause
// FitsDensity judges a chi-square test:
//   EXPECT_TRUE(FitsDensity(TestDirections({}, sample, pdf), 30));  // one of 30 such tests
#pragma once

#include <gtest/gtest.h>

#include "core/app/checks/chi_square.h"

namespace exphoton {

// Returns whether sampler and density agree, at a false-alarm rate of 1 % over `testCount` such
// tests (Sidak). Up to one sample in 500 may lie where the density is 0, because of rounding at an
// edge. The message contains the whole result.
testing::AssertionResult FitsDensity(const ChiSquareResult& result, int testCount);

}  // namespace exphoton
