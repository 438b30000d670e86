// SPDX-License-Identifier: BSD-2-Clause
#include "core/render/passes/progressive.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

namespace exphoton {
namespace {

// The mean of 1/area over n passes is the variance of their mean, times n. It must grow as
// n^(1 - alpha), which is the rule r_{i+1}^2 = r_i^2 (i + alpha) / (i + 1).
TEST(Progressive, DisksFollowTheRuleOfKnausAndZwicker) {
  for (const double alpha : {.1, 2. / 3, 1.}) {
    double area = 1;
    for (int pass = 0; pass < 300; ++pass) {
      EXPECT_NEAR(DiskAreaOfPass(pass, alpha), area, 1e-10 * area) << pass << " " << alpha;
      area *= (pass + 1 + alpha) / (pass + 2);
    }
  }
  EXPECT_NEAR(DiskAreaOfPass(799999, kProgressiveAlpha) / DiskAreaOfPass(99999, kProgressiveAlpha),
              .5, 1e-4);
}

TEST(Progressive, TimesOfPassesCoverTheExposure) {
  std::set<int> eighths;
  for (int pass = 0; pass < 8; ++pass) {
    const double time = double(TimeOfPass(pass, 3));
    EXPECT_GE(time, 0);
    EXPECT_LT(time, 1);
    eighths.insert(int(8 * time));
  }
  EXPECT_EQ(eighths.size(), 8u);
  EXPECT_NE(TimeOfPass(0, 3), TimeOfPass(0, 4));
}

}  // namespace
}  // namespace exphoton
