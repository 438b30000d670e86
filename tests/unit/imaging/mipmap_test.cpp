// SPDX-License-Identifier: BSD-2-Clause
// These tests check the MIP map: it keeps the mean at any size, keeps constant images constant
// under any filter, and has a bounded cost.
#include "core/imaging/mipmap.h"

#include <chrono>
#include <cmath>

#include "core/math/sampling/random.h"
#include "gtest/gtest.h"

namespace exphoton {
namespace {

constexpr WrapMode kWraps[] = {WrapMode::Repeat, WrapMode::Black, WrapMode::Clamp};

std::vector<Real> Noise(int count) {
  RandomStream random(1);
  std::vector<Real> values;
  for (int i = 0; i < count; ++i) values.push_back(random.Uniform());
  return values;
}
double Mean(const std::vector<Real>& values) {
  double sum = 0;
  for (Real v : values) sum += double(v);
  return sum / double(values.size());
}

TEST(MipMap, KeepsTheMeanAtEverySize) {
  const int sizes[][2] = {{1, 1}, {1, 7}, {3, 5}, {16, 16}, {17, 31}, {100, 1}, {64, 3}, {33, 255}};
  for (const auto& size : sizes) {
    const std::vector<Real> texels = Noise(size[0] * size[1]);
    const MipMap<Real> map(size[0], size[1], texels, WrapMode::Repeat);
    const int top = map.LevelCount() - 1;
    ASSERT_EQ(map.Width(top), 1);
    ASSERT_EQ(map.Height(top), 1);
    EXPECT_NEAR(map.Texel(top, 0, 0), Mean(texels), 1e-5) << size[0] << " x " << size[1];
  }
}

TEST(MipMap, OfOneColorIsThatColorUnderEveryFootprint) {
  const MipMap<Real> map(13, 40, std::vector<Real>(13 * 40, Real(.625)), WrapMode::Repeat);
  RandomStream random(2);
  for (int i = 0; i < 2000; ++i) {
    const auto any = [&] {
      return (random.Uniform() - Real(.5)) * std::exp2(-12 * random.Uniform());
    };
    const Point2 st(10 * any(), 10 * any()), dx(any(), any()), dy(any(), any());
    EXPECT_NEAR(map.Ewa(st, dx, dy, 8), .625, 1e-5);
    EXPECT_NEAR(map.Trilinear(st, dx, dy), .625, 1e-5);
    EXPECT_NEAR(map.Lookup(st), .625, 1e-5);
  }
}

// Filtering moves light but creates none, so the mean over the image stays the same.
TEST(MipMap, FilteringKeepsTheMean) {
  const int n = 32;
  const std::vector<Real> texels = Noise(n * n);
  const MipMap<Real> map(n, n, texels, WrapMode::Repeat);
  for (Real width : {Real(.01), Real(.05), Real(.2)}) {
    double ewa = 0, trilinear = 0;
    const int steps = 128;
    for (int y = 0; y < steps; ++y) {
      for (int x = 0; x < steps; ++x) {
        const Point2 st((Real(x) + Real(.5)) / steps, (Real(y) + Real(.5)) / steps);
        ewa += double(map.Ewa(st, {width, width / 3}, {0, width / 4}, 8));
        trilinear += double(map.Trilinear(st, {width, 0}, {0, width / 4}));
      }
    }
    EXPECT_NEAR(ewa / (steps * steps), Mean(texels), 5e-3) << width;
    EXPECT_NEAR(trilinear / (steps * steps), Mean(texels), 1e-3) << width;
  }
}

TEST(MipMap, WithoutAFootprintIsBilinear) {
  const MipMap<Real> map(2, 2, {0, 1, 2, 3}, WrapMode::Clamp);
  EXPECT_EQ(map.Lookup({Real(.25), Real(.25)}), 0);
  EXPECT_EQ(map.Lookup({Real(.75), Real(.25)}), 1);
  EXPECT_EQ(map.Lookup({Real(.25), Real(.75)}), 2);
  EXPECT_FLOAT_EQ(float(map.Lookup({Real(.5), Real(.5)})), 1.5f);
  EXPECT_EQ(map.Ewa({Real(.5), Real(.25)}, {}, {}, 8), map.Lookup({Real(.5), Real(.25)}));
  EXPECT_EQ(map.Trilinear({Real(.5), Real(.25)}, {}, {}), map.Lookup({Real(.5), Real(.25)}));
}

TEST(MipMap, WrapsAsAsked) {
  const std::vector<Real> texels{1, 2, 3, 4};
  EXPECT_EQ(MipMap<Real>(4, 1, texels, WrapMode::Repeat).Texel(0, -1, 5), 4);
  EXPECT_EQ(MipMap<Real>(4, 1, texels, WrapMode::Clamp).Texel(0, -1, 5), 1);
  EXPECT_EQ(MipMap<Real>(4, 1, texels, WrapMode::Black).Texel(0, -1, 0), 0);
  const MipMap<Real> black(4, 1, texels, WrapMode::Black), repeat(4, 1, texels, WrapMode::Repeat);
  EXPECT_EQ(black.Lookup({50, Real(.5)}), 0);
  EXPECT_EQ(repeat.Lookup({Real(50.125), Real(.5)}), 1);
}

// For a single bright texel, Ewa as a function of st is the filter itself. A round footprint of a
// texels is filtered on the level L with 2^L = a, by a Gaussian that is widened by one texel of the
// level. Its variance on each axis, about the centre of the level's texel, is
// 4^L ((a / 2^L)^2 + 1) m texels^2. The constant m = .1361 is the variance of exp(-2 r^2) - exp(-2)
// on the unit disk.
TEST(MipMap, EllipticalFilterIsAsWideAsItsFootprint) {
  constexpr int n = 256, kAt = 128, kReach = 24, kSteps = 4;
  std::vector<Real> texels(n * n, Real(0));
  texels[kAt * n + kAt] = 1;
  const MipMap<Real> map(n, n, texels, WrapMode::Repeat);
  for (const int level : {0, 1, 2}) {
    const double a = 1 << level;
    const Real step = Real(a / n);
    double sum = 0, square = 0, mean = 0;
    for (int y = -kReach * kSteps; y < kReach * kSteps; ++y) {
      for (int x = -kReach * kSteps; x < kReach * kSteps; ++x) {
        const double dx = (x + .5) / kSteps, dy = (y + .5) / kSteps;
        const Point2 st(Real((kAt + .5 + dx) / n), Real((kAt + .5 + dy) / n));
        const double value = double(map.Ewa(st, {step, 0}, {0, step}, 8));
        sum += value, mean += value * dx, square += value * dx * dx;
      }
    }
    const double texel = std::pow(4, level);
    const double center = mean / sum, variance = square / sum - center * center;
    const double expected = 2 * texel * .1361;
    EXPECT_NEAR(variance / expected, 1, .05) << "level " << level;
    EXPECT_NEAR(sum / (kSteps * kSteps), 1, .05) << "level " << level;
  }
}

// The footprint is long and diagonal, and the ellipse must keep the lengths and directions of its
// axes. With axes of a and b texels on the finest level, the variances along them are (a^2 + 1) m
// and (b^2 + 1) m.
TEST(MipMap, EllipticalFilterIsAsLongAndAsTurnedAsItsFootprint) {
  constexpr int n = 128, kAt = 64, kReach = 12, kSteps = 4;
  std::vector<Real> texels(n * n, Real(0));
  texels[kAt * n + kAt] = 1;
  const MipMap<Real> map(n, n, texels, WrapMode::Repeat);
  const Real a = Real(4 / std::sqrt(2.)) / n, b = Real(1 / std::sqrt(2.)) / n;
  double sum = 0, along = 0, across = 0, mixed = 0;
  for (int y = -kReach * kSteps; y < kReach * kSteps; ++y) {
    for (int x = -kReach * kSteps; x < kReach * kSteps; ++x) {
      const double dx = (x + .5) / kSteps, dy = (y + .5) / kSteps;
      const Point2 st(Real((kAt + .5 + dx) / n), Real((kAt + .5 + dy) / n));
      const double value = double(map.Ewa(st, {a, a}, {b, -b}, 8));
      const double u = (dx + dy) / std::sqrt(2.), v = (dx - dy) / std::sqrt(2.);
      sum += value, along += value * u * u, across += value * v * v, mixed += value * u * v;
    }
  }
  EXPECT_NEAR(along / sum / (17 * .1361), 1, .05);
  EXPECT_NEAR(across / sum / (2 * .1361), 1, .05);
  EXPECT_NEAR(mixed / sum, 0, .02);
  // With an anisotropy limit of 2, the short axis grows to half of the long axis. The lookup uses
  // the level of the new short axis.
  double limited = 0, limitedSum = 0;
  for (int i = -kReach * kSteps; i < kReach * kSteps; ++i) {
    const double v = (i + .5) / kSteps, d = v / std::sqrt(2.);
    const Point2 st(Real((kAt + .5 + d) / n), Real((kAt + .5 - d) / n));
    const double value = double(map.Ewa(st, {a, a}, {b, -b}, 2));
    limitedSum += value, limited += value * v * v;
  }
  EXPECT_GT(limited / limitedSum, 2 * across / sum);
}

// With an anisotropy limit of 2, the short axis of this footprint grows to 2 texels, and the
// long axis stays. On the level of 2 texels, the variances along the axes are 4 (2^2 + 1) m
// and 4 (1 + 1) m.
TEST(MipMap, EllipticalFilterThatIsLimitedGrowsAcrossOnly) {
  constexpr int n = 128, kAt = 64, kReach = 16, kSteps = 4;
  std::vector<Real> texels(n * n, Real(0));
  texels[kAt * n + kAt] = 1;
  const MipMap<Real> map(n, n, texels, WrapMode::Repeat);
  const Real a = Real(4 / std::sqrt(2.)) / n, b = Real(1 / std::sqrt(2.)) / n;
  for (const Real turn : {Real(1), Real(-1)}) {
    double sum = 0, u1 = 0, v1 = 0, along = 0, across = 0;
    for (int y = -kReach * kSteps; y < kReach * kSteps; ++y) {
      for (int x = -kReach * kSteps; x < kReach * kSteps; ++x) {
        const double dx = (x + .5) / kSteps, dy = (y + .5) / kSteps;
        const Point2 st(Real((kAt + .5 + dx) / n), Real((kAt + .5 + dy) / n));
        const double value = double(map.Ewa(st, {a, a * turn}, {b, -b * turn}, 2));
        const double u = (dx + dy * double(turn)) / std::sqrt(2.);
        const double v = (dx - dy * double(turn)) / std::sqrt(2.);
        sum += value, u1 += value * u, v1 += value * v;
        along += value * u * u, across += value * v * v;
      }
    }
    EXPECT_NEAR((along / sum - u1 * u1 / (sum * sum)) / (20 * .1361), 1, .05) << turn;
    EXPECT_NEAR((across / sum - v1 * v1 / (sum * sum)) / (8 * .1361), 1, .05) << turn;
  }
}

// Rows and columns of an uneven image are exchanged, and so are the axes of each footprint.
TEST(MipMap, TreatsBothAxesAlike) {
  constexpr int kWidth = 64, kHeight = 16;
  const std::vector<Real> texels = Noise(kWidth * kHeight);
  std::vector<Real> turned;
  for (int x = 0; x < kWidth; ++x)
    for (int y = 0; y < kHeight; ++y) turned.push_back(texels[std::size_t(y * kWidth + x)]);
  const MipMap<Real> wide(kWidth, kHeight, texels, WrapMode::Repeat);
  const MipMap<Real> tall(kHeight, kWidth, turned, WrapMode::Repeat);
  RandomStream random(4);
  const auto any = [&] { return (random.Uniform() - Real(.5)) * std::exp2(-6 * random.Uniform()); };
  const auto swap = [](Point2 p) { return Point2(p.y, p.x); };
  for (int i = 0; i < 1000; ++i) {
    const Point2 st(any(), any()), dx(any(), any()), dy(any(), any()), none;
    EXPECT_NEAR(wide.Lookup(st), tall.Lookup(swap(st)), 1e-5);
    for (const auto& [a, b] : {std::pair(dx, dy), std::pair(dx, none), std::pair(none, dy)}) {
      EXPECT_NEAR(wide.Trilinear(st, a, b), tall.Trilinear(swap(st), swap(a), swap(b)), 1e-5);
      EXPECT_NEAR(wide.Ewa(st, a, b, 8), tall.Ewa(swap(st), swap(a), swap(b), 8), 1e-5);
    }
  }
}

// A long thin footprint across stripes averages them. A footprint along stripes does not.
TEST(MipMap, EllipticalFilterIsSharpAcrossItsShortAxis) {
  const int n = 64;
  std::vector<Real> stripes;
  for (int y = 0; y < n; ++y)
    for (int x = 0; x < n; ++x) stripes.push_back(Real((x / 8) % 2));
  const MipMap<Real> map(n, n, stripes, WrapMode::Repeat);
  const Point2 st(Real(12) / n, Real(.5)), longStep(Real(.25), 0), shortStep(Real(.01), 0);
  const Point2 up(0, Real(.1)), low(0, Real(.01));
  EXPECT_GT(map.Ewa(st, shortStep, up, 10), Real(.95));
  EXPECT_LT(map.Ewa(st, longStep, low, 10), Real(.8));
  EXPECT_LT(map.Trilinear(st, shortStep, up), Real(.8));
}

TEST(MipMap, TurnsWithItsFootprint) {
  const int n = 64;
  std::vector<Real> diagonal;
  for (int y = 0; y < n; ++y)
    for (int x = 0; x < n; ++x) diagonal.push_back(Real(((x + y) / 8) % 2));
  const MipMap<Real> map(n, n, diagonal, WrapMode::Repeat);
  const Point2 st(Real(6) / n, Real(6) / n);  // the middle of a bright stripe
  EXPECT_GT(map.Ewa(st, {Real(.08), Real(-.08)}, {Real(.001), Real(.001)}, 16), Real(.9));
  EXPECT_LT(map.Ewa(st, {Real(.08), Real(.08)}, {Real(.001), Real(-.001)}, 16), Real(.7));
}

TEST(MipMap, SurvivesFootprintsThatAreNoNumbersOrHuge) {
  const Real nan = std::numeric_limits<Real>::quiet_NaN();
  const int sizes[][2] = {{256, 256}, {1, 4096}, {4096, 1}, {3, 1000}};
  const Real values[] = {0, nan, kInfinity, Real(1e30), Real(1e-30), Real(1e4), -1, Real(.05)};
  const auto start = std::chrono::steady_clock::now();
  for (const auto& size : sizes) {
    const std::vector<Real> texels = Noise(size[0] * size[1]);
    for (WrapMode wrap : kWraps) {
      const MipMap<Real> map(size[0], size[1], texels, wrap);
      for (Real a : values) {
        for (Real b : values) {
          for (Real st : {Real(.3), Real(-1e9), nan, kInfinity}) {
            for (const Real value :
                 {map.Ewa({st, Real(.5)}, {a, 0}, {0, b}, 64), map.Ewa({st, a}, {a, b}, {b, a}, 8),
                  map.Trilinear({st, b}, {a, b}, {b, a})}) {
              EXPECT_TRUE(value >= 0 && value <= Real(1.0001));
            }
          }
        }
      }
    }
  }
  // There are 9216 lookups of at most about 10^4 texels each. Scanning ellipses at the finest level
  // would take minutes.
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(20));
}

}  // namespace
}  // namespace exphoton
