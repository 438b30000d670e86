// SPDX-License-Identifier: BSD-2-Clause
// These tests compare the warps of the unit square, and the tabulated distributions, with formulas
// in double and with sums.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "core/math/sampling/distribution.h"
#include "core/math/sampling/mis.h"
#include "core/math/sampling/random.h"
#include "core/math/sampling/sampling.h"
#include "core/sampling/filter_table.h"

namespace exphoton {
namespace {

constexpr int kSide = 17;

template <class Check>
void ForEachPoint(const Check& check) {
  for (int j = 0; j < kSide; ++j)
    for (int i = 0; i < kSide; ++i)
      check(Point2{(Real(i) + Real(.3)) / kSide, (Real(j) + Real(.6)) / kSide});
}

void ExpectNear(const Vector3& v, double x, double y, double z) {
  EXPECT_NEAR(double(v.x), x, 1e-5);
  EXPECT_NEAR(double(v.y), y, 1e-5);
  EXPECT_NEAR(double(v.z), z, 1e-5);
}

// Shirley and Chiu 1997: squares go to circles, and the position along a quarter of a square's
// border is the azimuth.
TEST(Warps, TheDiskIsMadeOfConcentricSquares) {
  ForEachPoint([](Point2 u) {
    const double a = 2 * double(u.x) - 1, b = 2 * double(u.y) - 1;
    const double r = std::max(std::abs(a), std::abs(b));
    double turn;  // in quarters of pi
    if (std::abs(a) > std::abs(b)) {
      turn = a > 0 ? b / a : 4 + b / a;
    } else {
      turn = b > 0 ? 2 - a / b : 6 - a / b;
    }
    const Point2 p = SampleDisk(u);
    EXPECT_NEAR(double(p.x), r * std::cos(turn * M_PI / 4), 1e-5);
    EXPECT_NEAR(double(p.y), r * std::sin(turn * M_PI / 4), 1e-5);
    const Vector3 v = SampleCosineHemisphere(u);
    ExpectNear(v, double(p.x), double(p.y), std::sqrt(1 - r * r));
  });
  EXPECT_EQ(SampleDisk({Real(.5), Real(.5)}), Point2(0, 0));
}

TEST(Warps, OfSphereHemisphereAndConeAreLinearInTheCosine) {
  ForEachPoint([](Point2 u) {
    const double x = double(u.x), phi = 2 * M_PI * double(u.y);
    const auto check = [&](const Vector3& v, double cosine) {
      const double sine = std::sqrt(1 - cosine * cosine);
      ExpectNear(v, sine * std::cos(phi), sine * std::sin(phi), cosine);
    };
    check(SampleUniformSphere(u), 1 - 2 * x);
    check(SampleUniformHemisphere(u), 1 - x);
    check(SampleUniformCone(u, Real(.3)), 1 - .3 * x);
    EXPECT_NEAR(double(SampleTriangle(u).x), 1 - std::sqrt(x), 1e-6);
    EXPECT_NEAR(double(SampleTriangle(u).y), double(u.y) * std::sqrt(x), 1e-6);
  });
  EXPECT_NEAR(double(kUniformSpherePdf), 1 / (4 * M_PI), 1e-8);
  EXPECT_NEAR(double(kUniformHemispherePdf), 1 / (2 * M_PI), 1e-8);
  EXPECT_NEAR(double(UniformConePdf(Real(.3))), 1 / (2 * M_PI * .3), 1e-6);
  EXPECT_NEAR(double(CosineHemispherePdf(Real(.6))), .6 / M_PI, 1e-7);
  EXPECT_EQ(CosineHemispherePdf(Real(-.6)), 0);
  EXPECT_NEAR(double(OneMinusCos(Real(.7))), 1 - std::cos(.7), 1e-7);
}

TEST(Warps, PolarAnglesComeBack) {
  for (const double theta : {.1, 1., 2.5}) {
    for (const double phi : {.2, 1.7, 3.5, 6.1}) {
      const Vector3 v = SphericalDirection(Real(std::sin(theta)), Real(std::cos(theta)), Real(phi));
      ExpectNear(v, std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi),
                 std::cos(theta));
      EXPECT_NEAR(double(SphericalPhi(v)), phi, 1e-5);
      EXPECT_NEAR(double(SphericalTheta(v)), theta, 1e-5);
    }
  }
}

TEST(Distributions, ChooseByWeightAndSkipZeroes) {
  const std::vector<double> weights{0, 3, 0, 1, 4, 0};
  const DiscreteDistribution d(weights);
  EXPECT_EQ(d.Size(), 6);
  EXPECT_EQ(d.Sum(), 8);
  double low = 0;
  for (int i = 0; i < 6; ++i) {
    const double p = weights[std::size_t(i)] / 8;
    EXPECT_EQ(double(d.Probability(i)), p);
    if (p == 0) continue;
    for (const double share : {0., .25, .75}) {
      const auto choice = d.Sample(Real(low + share * p));
      EXPECT_EQ(choice.index, i);
      EXPECT_EQ(double(choice.probability), p);
      EXPECT_NEAR(double(choice.remapped), share, 1e-6);
    }
    low += p;
  }
  EXPECT_EQ(d.Sample(kOneMinusEpsilon).index, 4);
  EXPECT_TRUE(DiscreteDistribution(std::vector<double>{0, 0}).IsEmpty());
  EXPECT_EQ(DiscreteDistribution(std::vector<double>{0, 0}).Probability(1), 0);
}

TEST(Distributions, OfAStepFunctionInvertItsIntegral) {
  const std::vector<double> steps{1, 0, 5, 2};
  const PiecewiseConstant1D d(steps);
  EXPECT_EQ(d.Integral(), 2);
  EXPECT_EQ(d.Size(), 4);
  for (int i = 0; i < 4; ++i) {
    EXPECT_NEAR(double(d.Pdf(Real((i + .5) / 4))), steps[std::size_t(i)] / 2, 1e-6);
    EXPECT_NEAR(double(d.Pdf(Real((i + .01) / 4))), steps[std::size_t(i)] / 2, 1e-6);
  }
  // The first eighth of u lies in the first quarter, then 5/8 in the third.
  const auto first = d.Sample(Real(.0625)), third = d.Sample(Real(.25)),
             last = d.Sample(Real(.875));
  EXPECT_NEAR(double(first.x), .125, 1e-6);
  EXPECT_EQ(first.index, 0);
  EXPECT_NEAR(double(first.pdf), .5, 1e-6);
  EXPECT_NEAR(double(third.x), .5 + .25 * .2, 1e-6);
  EXPECT_EQ(third.index, 2);
  EXPECT_NEAR(double(third.pdf), 2.5, 1e-6);
  EXPECT_NEAR(double(last.x), .875, 1e-6);
  EXPECT_EQ(last.index, 3);
  const PiecewiseConstant1D black(std::vector<double>{0, 0, 0});
  EXPECT_EQ(black.Integral(), 0);
  EXPECT_NEAR(double(black.Sample(Real(.4)).x), .4, 1e-6);
  EXPECT_NEAR(double(black.Pdf(Real(.9))), 1, 1e-6);
}

// Of a picture of 3 x 2, each cell is taken as often as its value; u.y chooses the row.
TEST(Distributions, OfAPictureAreTheProductOfRowAndColumn) {
  const std::vector<double> values{1, 2, 3, 4, 0, 8};
  const PiecewiseConstant2D d(values, 3, 2);
  EXPECT_NEAR(d.Integral(), 3, 1e-12);
  for (int y = 0; y < 2; ++y)
    for (int x = 0; x < 3; ++x)
      EXPECT_NEAR(double(d.Pdf({Real((x + .5) / 3), Real((y + .5) / 2)})),
                  values[std::size_t(3 * y + x)] / 3, 1e-6);
  const Point2 a = d.Sample({Real(.25), Real(1. / 6)});
  EXPECT_NEAR(double(a.x), (1 + .25) / 3, 1e-6);
  EXPECT_NEAR(double(a.y), .25, 1e-6);
  const Point2 b = d.Sample({Real(.5), Real(2. / 3)});
  EXPECT_NEAR(double(b.x), (2 + .25) / 3, 1e-6);
  EXPECT_NEAR(double(b.y), .75, 1e-6);
}

TEST(PowerHeuristic, IsItsFormulaForAllCountsAndDensities) {
  RandomStream random(2);
  for (int i = 0; i < 500; ++i) {
    const int nf = 1 + int(5 * random.Uniform()), ng = 1 + int(5 * random.Uniform());
    const Real pf = 4 * random.Uniform(), pg = 4 * random.Uniform();
    const double f = nf * double(pf), g = ng * double(pg);
    EXPECT_NEAR(double(PowerHeuristic(nf, pf, ng, pg)), f * f / (f * f + g * g), 1e-6);
  }
  EXPECT_EQ(PowerHeuristic(1, 0, 1, 0), 0);
  EXPECT_EQ(PowerHeuristic(1, 1, 1, 0), 1);
  EXPECT_EQ(PowerHeuristic(0, 1, 1, 1), 0);
  EXPECT_EQ(PowerHeuristic(1, kInfinity, 1, 1), 1);
  EXPECT_EQ(PowerHeuristic(1, 1, 1, kInfinity), 0);
  EXPECT_EQ(PowerHeuristic(1, kInfinity, 1, kInfinity), Real(.5));
  EXPECT_NEAR(double(PowerHeuristic(1, Real(1e30), 1, Real(1e30))), .5, 1e-6);
}

// The table of a filter draws x by |f|: the integral of |f| up to x is u. Where f is below 0 the
// weight is below 0 too. Its size is the integral of |f| over the integral of f.
TEST(FilterTables, InvertTheIntegralOfTheAbsoluteFilter) {
  const auto f = [](double x) { return std::cos(2 * x); };
  constexpr double kWidth = 1.2;
  const FilterTable table(f, kWidth);
  const double positive = .5, whole = std::sin(2 * kWidth) / 2, all = 2 * positive - whole;
  const auto area = [&](double x) {  // of |f| over [0, x]
    return x < M_PI / 4 ? std::sin(2 * x) / 2 : 2 * positive - std::sin(2 * x) / 2;
  };
  for (int i = 0; i < 100; ++i) {
    const Real u = (Real(i) + Real(.4)) / 100;
    const auto value = table.Sample(u);
    const double v = 2 * double(u) - 1;
    EXPECT_EQ(value.x < 0, v < 0);
    EXPECT_NEAR(area(std::abs(double(value.x))), std::abs(v) * all, 1e-4);
    const double weight = f(double(value.x)) > 0 ? all / whole : -all / whole;
    EXPECT_NEAR(double(value.weight), weight, 2e-3);
  }
}

// Keys of random numbers depend on every part and on their order.
TEST(RandomKeys, DependOnEachPartAndItsPlace) {
  const std::uint64_t key = HashKey({1, 2, 3});
  EXPECT_NE(key, HashKey({4, 2, 3}));
  EXPECT_NE(key, HashKey({1, 4, 3}));
  EXPECT_NE(key, HashKey({1, 2, 4}));
  EXPECT_NE(key, HashKey({2, 1, 3}));
  EXPECT_NE(key, HashKey({1, 3, 2}));
  EXPECT_NE(key, HashKey({1, 2}));
  EXPECT_NE(key, HashKey({1, 2, 3, 0}));
  EXPECT_EQ(UniformFromBits(~std::uint64_t(0)), kOneMinusEpsilon);
  EXPECT_EQ(UniformFromBits(std::uint64_t(1) << 63), Real(.5));
  EXPECT_EQ(UniformFromBits(0), 0);
}

// Permutations of every length hold each index once, and keys change them.
TEST(RandomKeys, PermuteEveryLengthOnce) {
  for (const std::uint32_t length : {1u, 2u, 3u, 7u, 16u, 17u, 64u, 100u}) {
    int same = 0;
    for (std::uint32_t key = 0; key < 8; ++key) {
      std::vector<int> seen(length, 0);
      for (std::uint32_t i = 0; i < length; ++i) {
        const std::uint32_t to = PermuteIndex(i, length, key * 0x9e3779b9u);
        ASSERT_LT(to, length);
        ++seen[to];
        same += to == i;
      }
      for (const int count : seen) EXPECT_EQ(count, 1) << length;
    }
    if (length > 3) {
      EXPECT_LT(same, int(length) * 4) << "mostly the identity";
    }
  }
}

}  // namespace
}  // namespace exphoton
