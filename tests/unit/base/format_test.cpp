// SPDX-License-Identifier: BSD-2-Clause
#include "core/base/format.h"

#include <gtest/gtest.h>

namespace exphoton {
namespace {

TEST(Plain, HasNoExponent) {
  EXPECT_EQ(Plain(10.4, 1), "10");
  EXPECT_EQ(Plain(112, 2), "110");
  EXPECT_EQ(Plain(1581, 3), "1580");
  EXPECT_EQ(Plain(-99.9, 1), "-100");
  EXPECT_EQ(Plain(.0000123, 2), "0.000012");
  EXPECT_EQ(Plain(.00000999, 1), "0.00001");
  EXPECT_EQ(Plain(-.00001, 3), "-0.00001");
}

TEST(Plain, HasTheDigitsOfShortNumbers) {
  EXPECT_EQ(Plain(0, 2), "0");
  EXPECT_EQ(Plain(5, 3), "5");
  EXPECT_EQ(Plain(9.876, 3), "9.88");
  EXPECT_EQ(Plain(.0522, 2), "0.052");
  EXPECT_EQ(Plain(1e-14, 2), "0");
}

}  // namespace
}  // namespace exphoton
