// SPDX-License-Identifier: BSD-2-Clause
// These tests compare optimised functions for low-discrepancy points with their definitions.
#include "core/math/sampling/low_discrepancy.h"

#include <gtest/gtest.h>

namespace exphoton {
namespace {

// Returns a number of the second Sobol' dimension from its direction numbers, by their recurrence
// v_1 = 1/2, v_{k+1} = v_k xor v_k / 2 (primitive polynomial x + 1).
std::uint32_t SecondByRecurrence(std::uint32_t index) {
  std::uint32_t sum = 0;
  for (std::uint32_t v = 1u << 31; index != 0; index >>= 1, v ^= v >> 1)
    if (index & 1) sum ^= v;
  return sum;
}

TEST(LowDiscrepancy, SecondSobolDimensionIsThatOfItsDirectionNumbers) {
  for (int bit = 0; bit < 32; ++bit)
    EXPECT_EQ(SobolSecond(1u << bit), SecondByRecurrence(1u << bit)) << bit;
  RandomStream random(1);
  for (int i = 0; i < 10000; ++i) {
    const auto index = std::uint32_t(random.Bits());
    ASSERT_EQ(SobolSecond(index), SecondByRecurrence(index)) << index;
  }
}

// The first two points lie in different halves along each axis. Whether they have matching places
// within these halves along x must be independent of whether they do along y.
TEST(LowDiscrepancy, ScramblesBothDimensionsIndependently) {
  constexpr int kKeys = 4000;
  const auto quarter = [](Real u) { return int(4 * u) % 2; };
  int agree = 0;
  for (int i = 0; i < kKeys; ++i) {
    const std::uint64_t key = HashKey({std::uint64_t(i), 5});
    const Point2 a = ScrambledSobol2(0, key), b = ScrambledSobol2(1, key);
    ASSERT_NE(a.x < Real(.5), b.x < Real(.5));
    ASSERT_NE(a.y < Real(.5), b.y < Real(.5));
    agree += (quarter(a.x) == quarter(b.x)) == (quarter(a.y) == quarter(b.y));
  }
  EXPECT_NEAR(agree, .5 * kKeys, 5 * std::sqrt(.25 * kKeys));
}

TEST(LowDiscrepancy, ReversingBitsPutsBitKAtPlace31MinusK) {
  for (int bit = 0; bit < 32; ++bit) EXPECT_EQ(ReverseBits32(1u << bit), 1u << (31 - bit));
}

TEST(LowDiscrepancy, PermutingAllIsPermutingEach) {
  for (std::uint32_t key = 0; key < 1000; ++key) {
    std::uint8_t all[16];
    PermuteAll(key, all);
    for (std::uint32_t i = 0; i < 16; ++i) ASSERT_EQ(all[i], PermuteIndex(i, 16, key)) << key;
  }
}

}  // namespace
}  // namespace exphoton
