// SPDX-License-Identifier: BSD-2-Clause
// Tests of the instrumentation itself, in a build with EXPHOTON_STOCHASTIC: each operation in
// single precision gives one of the two neighbours of the exact result, with equal chances.
#ifdef EXPHOTON_STOCHASTIC

#include "tests/rounding/runtime/rounding.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <vector>

#include "core/math/real.h"

namespace exphoton::rounding {
namespace {

// Volatile, so that the compiler computes nothing ahead.
volatile Real one = 1, two = 2, three = 3, tiny = kMachineEpsilon / 64;
// 1 + small and 1 - small are exact, and their product is not.
volatile Real small = kMachineEpsilon < Real(1e-9) ? Real(0x1p-28) : Real(0x1p-13);
#ifndef EXPHOTON_DOUBLE
volatile double third = 1. / 3;
volatile int large = 0x1000001;
#endif

class Rounding : public testing::Test {
 protected:
  void TearDown() override { RoundAtRandom(0); }
};

struct Operation {
  const char* name;
  std::function<Real()> result;
  long double exact;
};

const std::vector<Operation>& Operations() {
  static const long double t = tiny, s = small;
  static const std::vector<Operation> operations = {
      {"sum", [] { return one + tiny; }, 1 + t},
      {"difference", [] { return one - tiny; }, 1 - t},
      {"product", [] { return (one + small) * (one - small); }, 1 - s * s},
      {"quotient", [] { return one / three; }, 1 / 3.L},
      {"square root", [] { return std::sqrt(Real(two)); }, std::sqrt(2.L)},
#ifndef EXPHOTON_DOUBLE  // the library's functions in double are not changed
      {"from double", [] { return Real(third); }, 1. / 3},
      {"from int", [] { return Real(large); }, 0x1000001},
      {"sine", [] { return std::sin(Real(one)); }, std::sin(1.L)},
      {"cosine", [] { return std::cos(Real(one)); }, std::cos(1.L)},
      {"power", [] { return std::pow(Real(three), Real(tiny)); }, std::pow(3.L, t)},
      {"exponential", [] { return std::exp(Real(one)); }, std::exp(1.L)},
      {"angle", [] { return std::atan2(Real(one), Real(three)); }, std::atan2(1.L, 3.L)},
#endif
  };
  return operations;
}

TEST_F(Rounding, GivesEachNeighbourInHalfOfAllCases) {
  constexpr int kTries = 10000;
  RoundAtRandom(1);
  for (const Operation& operation : Operations()) {
    int above = 0;
    for (int i = 0; i < kTries; ++i) {
      const Real result = operation.result();
      const bool isAbove = result > operation.exact;
      const Real other = isAbove ? NextDown(result) : NextUp(result);
      ASSERT_TRUE(isAbove ? other < operation.exact : other > operation.exact)
          << operation.name << " gave " << double(result);
      above += isAbove;
    }
    // Six standard deviations of a fair coin: 1e-8 in all.
    EXPECT_NEAR(above, kTries / 2, 300) << operation.name;
  }
}

TEST_F(Rounding, LeavesExactResultsAlone) {
  RoundAtRandom(1);
  for (int i = 0; i < 1000; ++i) {
    ASSERT_EQ(one + two, 3);
    ASSERT_EQ(three * two, 6);
    ASSERT_EQ(three / two, Real(1.5));
    ASSERT_EQ(std::sqrt(Real(one)), 1);
    ASSERT_EQ(one - one, 0);
    ASSERT_FALSE(std::signbit(one - one));
  }
}

TEST_F(Rounding, IsToNearestForTheKeyZero) {
  RoundAtRandom(0);
  for (int i = 0; i < 1000; ++i) {
    ASSERT_EQ(one / three, Real(1) / Real(3));
    ASSERT_EQ(one + tiny, 1);
  }
}

Real LongSum(std::uint64_t key) {
  RoundAtRandom(key);
  Real sum = 0;
  for (int i = 1; i < 1000; ++i) sum += one / Real(i);
  return sum;
}

TEST_F(Rounding, RepeatsForEqualKeysAndDiffersForOthers) {
  EXPECT_EQ(LongSum(5), LongSum(5));
  int different = 0;
  for (std::uint64_t key = 1; key <= 16; ++key) different += LongSum(key) != LongSum(0);
  EXPECT_GE(different, 14);
}

#ifndef EXPHOTON_DOUBLE
TEST_F(Rounding, LeavesDoublePrecisionAlone) {
  const volatile double x = 3;
  const double first = 1 / x + std::sqrt(x);
  RoundAtRandom(1);
  for (int i = 0; i < 1000; ++i) ASSERT_EQ(1 / x + std::sqrt(x), first);
}

TEST_F(Rounding, CountsBitsThatDifferencesLose) {
  const volatile float close = 1 + 0x1p-20f, far = 1 + 0x1p-10f;
  CountCancellations(true);
  volatile float a = close - one;  // loses 20 bits
  volatile float b = far - one;    // loses 10 bits
  volatile float c = one - one;
  CountCancellations(false);
  volatile float d = close - one;  // the census is over
  (void)a, (void)b, (void)c, (void)d;
  double bits = 0;
  std::uint64_t count = 0, zeros = 0;
  for (const Cancellations& each : TakeCancellations()) {
    count += each.count;
    zeros += each.zeros;
    bits += each.bits;
  }
  EXPECT_EQ(count, 1u);
  EXPECT_EQ(zeros, 1u);
  EXPECT_EQ(bits, 20);
  EXPECT_TRUE(TakeCancellations().empty());
}

#endif

}  // namespace
}  // namespace exphoton::rounding

#endif
