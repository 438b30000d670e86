// SPDX-License-Identifier: BSD-2-Clause
// These tests check the strata and nets of the stratified and the low-discrepancy sampler, and the
// independence of points beyond these properties.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <set>
#include <vector>

#include "core/sampling/sampler.h"
#include "tests/support/sampler_checks.h"
#include "tests/support/test_plugin.h"

namespace exphoton {
namespace {

TEST(StratifiedSampler, EachStratumIsTakenOnce) {
  TestPlugins plugins;
  const auto sampler = plugins.MakeSampler(kSamplers[1]);
  const Requests r;
  for (int seed = 0; seed < 50; ++seed) {
    std::vector<Point2> film, lens, single2, array2;
    std::vector<Real> time, single, array, odd, oddX;
    for (int i = 0; i < 16; ++i) {
      CameraSamples s{r.layout};
      sampler->Generate({std::uint64_t(seed), {5, 6}, i}, &s);
      film.push_back(s.film), lens.push_back(s.lens), time.push_back(s.time);
      single.push_back(s.Array1D(r.one)[0]);
      single2.push_back(s.Array2D(r.one2)[0]);
      const auto eight = s.Array1D(r.eight);
      EXPECT_TRUE(IsStratified({eight.begin(), eight.end()}, 8));
      array.insert(array.end(), eight.begin(), eight.end());
      const auto seven = s.Array1D(r.odd);
      EXPECT_TRUE(IsStratified({seven.begin(), seven.end()}, 7));
      odd.insert(odd.end(), seven.begin(), seven.end());
      const auto sixteen = s.Array2D(r.sixteen2);
      EXPECT_TRUE(IsStratified(std::vector<Point2>(sixteen.begin(), sixteen.end()), 4, 4));
      EXPECT_TRUE(IsStratified(std::vector<Point2>(sixteen.begin(), sixteen.end()), 16, 1));
      EXPECT_TRUE(IsStratified(std::vector<Point2>(sixteen.begin(), sixteen.end()), 1, 16));
      array2.insert(array2.end(), sixteen.begin(), sixteen.end());
      for (Point2 p : s.Array2D(r.odd2)) oddX.push_back(p.x);
    }
    EXPECT_TRUE(IsStratified(film, 4, 4));
    EXPECT_TRUE(IsStratified(lens, 4, 4));
    EXPECT_TRUE(IsStratified(single2, 4, 4));
    EXPECT_TRUE(IsStratified(time, 16));
    EXPECT_TRUE(IsStratified(single, 16));
    EXPECT_TRUE(IsStratified(array, 8 * 16));
    EXPECT_TRUE(IsStratified(array2, 4, 4));
    EXPECT_TRUE(IsStratified(array2, 16 * 16, 1));
    EXPECT_TRUE(IsStratified(array2, 1, 16 * 16));
    EXPECT_EQ(odd.size(), 7u * 16);
    EXPECT_TRUE(IsStratified(odd, 7));
    EXPECT_TRUE(IsStratified(oddX, 13));
  }
}

TEST(StratifiedSampler, WithoutJitterTakesTheCentres) {
  TestPlugins plugins;
  const auto sampler = plugins.MakeSampler(kSamplers[2]);
  std::set<Real> xs;
  for (int i = 0; i < 16; ++i) {
    CameraSamples s{SampleLayout{}};
    sampler->Generate({0, {0, 0}, i}, &s);
    EXPECT_EQ(s.film.y, Real(.5));
    xs.insert(s.film.x * 16);
  }
  EXPECT_EQ(xs.size(), 16u);
  EXPECT_EQ(*xs.begin(), Real(.5));
}

TEST(LowDiscrepancySampler, FewSamplesAreANetToo) {
  TestPlugins plugins;
  for (int count : {1, 2, 4, 8}) {
    const auto sampler = plugins.MakeSampler(kSamplers[3])->WithSamplesPerPixel(count);
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
      std::vector<Point2> film;
      for (int i = 0; i < count; ++i) {
        CameraSamples s{SampleLayout{}};
        sampler->Generate({seed, {1, 2}, i}, &s);
        film.push_back(s.film);
      }
      EXPECT_TRUE(IsNet(film)) << count;
    }
  }
}

// The test counts how often film and lens fall into matching halves. If this is independent from
// sample to sample, the mean over a pixel's 64 samples has the variance 1/4 / 64.
TEST(LowDiscrepancySampler, RequestsAreIndependentWithinAPixel) {
  TestPlugins plugins;
  const auto sampler = plugins.MakeSampler(R"("lowdiscrepancy" "integer pixelsamples" 64)");
  constexpr int kPixels = 4000;
  double squares = 0;
  for (int pixel = 0; pixel < kPixels; ++pixel) {
    int same = 0;
    for (int i = 0; i < 64; ++i) {
      CameraSamples s{SampleLayout{}};
      sampler->Generate({5, {pixel, 3}, i}, &s);
      same += (s.film.x < Real(.5)) == (s.lens.x < Real(.5));
    }
    squares += (same / 64. - .5) * (same / 64. - .5);
  }
  // The variance of an estimated variance is about 2/n of its square. The tolerance is 5 standard
  // deviations plus 7 %.
  EXPECT_NEAR(squares / kPixels * 4 * 64, 1, .07 + 5 * std::sqrt(2. / kPixels));
}

// The keys that scramble x and y are independent. The two samples of a pixel lie in different
// halves along each axis. Whether they have matching places within these halves along x must be
// independent of whether they do along y.
TEST(LowDiscrepancySampler, ScramblesItsTwoAxesIndependently) {
  TestPlugins plugins;
  const auto sampler = plugins.MakeSampler(kSamplers[3])->WithSamplesPerPixel(2);
  constexpr int kPixels = 4000;
  const auto quarter = [](Real u) { return int(4 * u) % 2; };
  const auto agree = [&](Point2 a, Point2 b) {
    EXPECT_NE(a.x < Real(.5), b.x < Real(.5));
    EXPECT_NE(a.y < Real(.5), b.y < Real(.5));
    return (quarter(a.x) == quarter(b.x)) == (quarter(a.y) == quarter(b.y));
  };
  SampleLayout layout;
  const int two = layout.Request2D(2);
  int film = 0, array = 0;
  for (int pixel = 0; pixel < kPixels; ++pixel) {
    CameraSamples a(layout), b(layout);
    sampler->Generate({3, {pixel, 1}, 0}, &a);
    sampler->Generate({3, {pixel, 1}, 1}, &b);
    film += agree(a.film, b.film);
    array += agree(a.Array2D(two)[0], a.Array2D(two)[1]);
  }
  const double deviation = std::sqrt(.25 * kPixels);
  EXPECT_NEAR(film, .5 * kPixels, 5 * deviation);
  EXPECT_NEAR(array, .5 * kPixels, 5 * deviation);
}

TEST(LowDiscrepancySampler, PowersOfTwoAreNets) {
  TestPlugins plugins;
  const auto sampler = plugins.MakeSampler(R"("lowdiscrepancy" "integer pixelsamples" 64)");
  const Requests r;
  for (int seed = 0; seed < 20; ++seed) {
    std::vector<Point2> film, lens, single2, array2;
    std::vector<Real> time, single, array;
    for (int i = 0; i < 64; ++i) {
      CameraSamples s{r.layout};
      sampler->Generate({std::uint64_t(seed), {50, 6}, i}, &s);
      film.push_back(s.film), lens.push_back(s.lens), time.push_back(s.time);
      single.push_back(s.Array1D(r.one)[0]);
      single2.push_back(s.Array2D(r.one2)[0]);
      const auto eight = s.Array1D(r.eight);
      EXPECT_TRUE(IsStratified({eight.begin(), eight.end()}, 8));
      array.insert(array.end(), eight.begin(), eight.end());
      const auto sixteen = s.Array2D(r.sixteen2);
      EXPECT_TRUE(IsNet({sixteen.begin(), sixteen.end()}));
      array2.insert(array2.end(), sixteen.begin(), sixteen.end());
      if (i + 1 < 16 || ((i + 1) & i) != 0) continue;  // a render may stop here
      EXPECT_TRUE(IsNet(film)) << i;
      EXPECT_TRUE(IsNet(lens)) << i;
      EXPECT_TRUE(IsNet(single2)) << i;
      EXPECT_TRUE(IsNet(array2)) << i;
      EXPECT_TRUE(IsStratified(time, i + 1));
      EXPECT_TRUE(IsStratified(single, i + 1));
      EXPECT_TRUE(IsStratified(array, 8 * (i + 1)));
    }
  }
}

// An array of three points leaves out a quarter of the domain, but another one in each sample.
TEST(LowDiscrepancySampler, ArraysOfOtherCountsSeeTheWholeDomain) {
  constexpr int kSamples = 4096, kCount = 3, kStrata = 4;
  SampleLayout layout;
  const int handle1D = layout.Request1D(kCount), handle2D = layout.Request2D(kCount);
  CameraSamples samples(layout);
  TestPlugins plugins;
  const auto sampler = plugins.MakeSampler(R"("lowdiscrepancy" "integer pixelsamples" 4096)");
  std::array<int, kStrata> found1D{}, foundX{}, foundY{};
  for (int i = 0; i < kSamples; ++i) {
    sampler->Generate({7, {3, 4}, i}, &samples);
    for (const Real value : samples.Array1D(handle1D)) ++found1D[std::size_t(value * kStrata)];
    for (const Point2& point : samples.Array2D(handle2D))
      ++foundX[std::size_t(point.x * kStrata)], ++foundY[std::size_t(point.y * kStrata)];
  }
  // Each sample leaves a stratum out with the probability 1/4, so counts spread by 28.
  for (const auto& found : {found1D, foundX, foundY})
    for (const int count : found) EXPECT_NEAR(count, kSamples * kCount / kStrata, 120);
}

TEST(LowDiscrepancySampler, GoesOnBeyondFourBillionPoints) {
  TestPlugins plugins;
  const auto sampler = plugins.MakeSampler(kSamplers[3]);
  const Requests r;
  for (std::int64_t first : {(1ll << 32) - 8, (1ll << 28) - 8, 1ll << 40}) {
    std::set<Real> values;
    for (std::int64_t i = first; i < first + 16; ++i) {
      CameraSamples s{r.layout};
      sampler->Generate({0, {0, 0}, i}, &s);
      const auto sixteen = s.Array2D(r.sixteen2);
      EXPECT_TRUE(IsNet({sixteen.begin(), sixteen.end()}));
      for (Point2 p : sixteen) values.insert(p.x);
    }
    EXPECT_GE(values.size(), 254u);
  }
}

TEST(LowDiscrepancySampler, RoundsCountsToPowersOfTwo) {
  TestPlugins plugins;
  const auto sampler = plugins.MakeSampler(R"("lowdiscrepancy" "integer pixelsamples" 3)");
  EXPECT_EQ(sampler->SamplesPerPixel(), 4);
  EXPECT_EQ(plugins.GetLog().WarningCount(), 1);
  EXPECT_EQ(sampler->RoundCount(0), 1);
  EXPECT_EQ(sampler->RoundCount(1), 1);
  EXPECT_EQ(sampler->RoundCount(5), 8);
  EXPECT_EQ(sampler->RoundCount(64), 64);
  EXPECT_EQ(sampler->WithSamplesPerPixel(17)->SamplesPerPixel(), 32);
  EXPECT_EQ(
      plugins.MakeSampler(R"("lowdiscrepancy" "integer pixelsamples" 1048576)")->SamplesPerPixel(),
      1 << 20);
}

// Other counts divide into the most nearly square grid: 12 points into 3 x 4 cells, 7 into a grid
// of 9 cells, of which each takes one point at most.
TEST(StratifiedSampler, OtherCountsHaveTheirOwnGrid) {
  TestPlugins plugins;
  const auto stratified = plugins.MakeSampler(R"("stratified")");
  EXPECT_EQ(stratified->SamplesPerPixel(), 4);
  CameraSamples first{SampleLayout{}};
  stratified->Generate({3, {5, 6}, 0}, &first);
  EXPECT_NE(2 * first.film.x - std::floor(2 * first.film.x), Real(.5));  // jittered
  const auto filmOf = [&](std::int64_t count) {
    const auto sampler = stratified->WithSamplesPerPixel(count);
    EXPECT_EQ(sampler->SamplesPerPixel(), count);
    std::vector<Point2> film;
    for (int i = 0; i < count; ++i) {
      CameraSamples s{SampleLayout{}};
      sampler->Generate({3, {5, 6}, i}, &s);
      film.push_back(s.film);
    }
    return film;
  };
  EXPECT_TRUE(IsStratified(filmOf(16), 4, 4));
  EXPECT_TRUE(IsStratified(filmOf(12), 3, 4));
  EXPECT_TRUE(IsStratified(filmOf(4), 2, 2));
  EXPECT_TRUE(IsStratified(filmOf(2), 1, 2));
  std::set<int> cells;
  for (const Point2 p : filmOf(7)) cells.insert(int(3 * p.x) + 3 * int(3 * p.y));
  EXPECT_EQ(cells.size(), 7u);
}

TEST(StratifiedSampler, ArraysThatAreNotSquareAreStratifiedAlongBothAxes) {
  TestPlugins plugins;
  const auto sampler = plugins.MakeSampler(R"("stratified")");
  const struct {
    int count, columns, rows;
  } arrays[] = {{8, 4, 2}, {12, 4, 3}, {6, 3, 2}, {13, 13, 1}, {2, 2, 1}};
  SampleLayout layout;
  std::vector<int> requests;
  for (const auto& array : arrays) requests.push_back(layout.Request2D(array.count));
  for (int i = 0; i < 40; ++i) {
    CameraSamples s(layout);
    sampler->Generate({1, {i, 7}, i % 4}, &s);
    for (std::size_t k = 0; k < requests.size(); ++k) {
      const auto [count, columns, rows] = arrays[k];
      const auto array = s.Array2D(requests[k]);
      const std::vector<Point2> points(array.begin(), array.end());
      EXPECT_TRUE(IsStratified(points, columns, rows)) << count;
      EXPECT_TRUE(IsStratified(points, count, 1)) << count;
      EXPECT_TRUE(IsStratified(points, 1, count)) << count;
    }
  }
}

TEST(StratifiedSampler, WithoutJitterTakesTheCentresOfLensAndTimeToo) {
  TestPlugins plugins;
  const auto sampler = plugins.MakeSampler(
      R"("stratified" "integer xsamples" 2 "integer ysamples" 4 "bool jitter" "false")");
  std::set<std::pair<Real, Real>> film, lens;
  std::set<Real> time;
  for (int i = 0; i < 8; ++i) {
    CameraSamples s{Requests().layout};
    sampler->Generate({0, {0, 0}, i}, &s);
    film.insert({s.film.x * 2, s.film.y * 4});
    lens.insert({s.lens.x * 2, s.lens.y * 4});
    time.insert(s.time * 8);
  }
  for (int i = 0; i < 8; ++i) {
    EXPECT_TRUE(film.contains({Real(i % 2) + Real(.5), Real(i / 2) + Real(.5)})) << i;
    EXPECT_TRUE(lens.contains({Real(i % 2) + Real(.5), Real(i / 2) + Real(.5)})) << i;
    EXPECT_TRUE(time.contains(Real(i) + Real(.5))) << i;
  }
}

// Choices of lights and lobes would repeat in every pixel.
TEST(StratifiedSampler, WithoutJitterKeepsTheChoicesRandom) {
  TestPlugins plugins;
  const auto sampler = plugins.MakeSampler(
      R"("stratified" "integer xsamples" 2 "integer ysamples" 4 "bool jitter" "false")");
  const Requests requests;
  std::set<Real> ones, xs, ys;
  for (int x = 0; x < 20; ++x) {
    CameraSamples s{Requests().layout};
    sampler->Generate({0, {x, 0}, x % 8}, &s);
    ones.insert(s.Array1D(requests.one)[0]);
    xs.insert(s.Array2D(requests.one2)[0].x);
    ys.insert(s.Array2D(requests.one2)[0].y);
  }
  EXPECT_EQ(ones.size(), 20u);
  EXPECT_EQ(xs.size(), 20u);
  EXPECT_EQ(ys.size(), 20u);
}

}  // namespace
}  // namespace exphoton
