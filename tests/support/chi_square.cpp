// SPDX-License-Identifier: BSD-2-Clause
// FitsDensity puts the whole result into its message.
#include "tests/support/chi_square.h"

namespace exphoton {

testing::AssertionResult FitsDensity(const ChiSquareResult& result, int testCount) {
  const double significance = SignificanceOf(.01, testCount);
  const bool fits = result.pValue >= significance && result.impossible <= result.samples / 500 &&
                    result.mass <= 1.005 && result.degrees > 0;
  auto answer = fits ? testing::AssertionSuccess() : testing::AssertionFailure();
  return answer << "chi-square " << result.statistic << " with " << result.degrees
                << " degrees of freedom, p = " << result.pValue << " (at least " << significance
                << "); density integrates to " << result.mass << "; " << result.impossible
                << " samples where the density is 0";
}

}  // namespace exphoton
