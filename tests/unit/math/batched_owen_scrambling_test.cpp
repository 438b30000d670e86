// SPDX-License-Identifier: BSD-2-Clause
// These tests compare batched Owen scrambling with scrambling one point at a time, for
// every SIMD target.
#include "core/math/sampling/batched_owen_scrambling.h"

#include <gtest/gtest.h>

#include <vector>

#include "core/math/sampling/low_discrepancy.h"

namespace exphoton {
namespace {

TEST(BatchedOwenScrambling, GivesThePointsOfTheSequenceWithEveryWidthOfVectors) {
  RandomStream random(1);
  for (std::size_t count = 0; count < 70; ++count) {
    const auto key = std::uint32_t(random.Bits());
    std::vector<std::uint32_t> indices(count);
    for (std::uint32_t& index : indices) index = std::uint32_t(random.Bits());
    std::vector<Real> expected(count);
    for (std::size_t i = 0; i < count; ++i) expected[i] = ScrambledVanDerCorput(indices[i], key);
    for (const Scrambler scramble : AvailableScramblers()) {
      std::vector<Real> values(count + 1, -1);
      scramble(indices.data(), count, key, values.data());
      EXPECT_EQ(values.back(), -1) << "wrote past the end";
      values.pop_back();
      EXPECT_EQ(values, expected) << count;
    }
  }
}

TEST(BatchedOwenScrambling, KeepsTheHighestFractionBelowOne) {
  EXPECT_LT(FractionToReal(0xffffffffu), 1);
  EXPECT_EQ(FractionToReal(0x80000000u), Real(.5));
  EXPECT_EQ(FractionToReal(0), 0);
}

}  // namespace
}  // namespace exphoton
