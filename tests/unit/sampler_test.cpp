// SPDX-License-Identifier: BSD-2-Clause
// Samplers: strata, nets, independence of seeds and requests, keys, ranges.
#include "core/sampling/sampler.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <tuple>
#include <vector>

#include "core/base/error.h"
#include "tests/support/test_plugin.h"

namespace exphoton {
namespace {

const char* const kSamplers[] = {
    R"("random" "integer xsamples" 4 "integer ysamples" 4)",
    R"("stratified" "integer xsamples" 4 "integer ysamples" 4)",
    R"("stratified" "integer xsamples" 16 "integer ysamples" 1 "bool jitter" "false")",
    R"("lowdiscrepancy" "integer pixelsamples" 16)",
};

struct Requests {
  SampleLayout layout;
  int one, eight, one2, sixteen2, odd, odd2;

  Requests()
      : one(layout.Request1D(1)),
        eight(layout.Request1D(8)),
        one2(layout.Request2D(1)),
        sixteen2(layout.Request2D(16)),
        odd(layout.Request1D(7)),
        odd2(layout.Request2D(13)) {
    layout.Request2D(0);
  }
};

// All numbers of a sample in a row.
std::vector<Real> Flatten(const CameraSamples& s) {
  std::vector<Real> all = {s.film.x, s.film.y, s.lens.x, s.lens.y, s.time};
  for (int i = 0; i < s.Count1D(); ++i)
    for (Real u : s.Array1D(i)) all.push_back(u);
  for (int i = 0; i < s.Count2D(); ++i)
    for (Point2 u : s.Array2D(i)) all.insert(all.end(), {u.x, u.y});
  return all;
}

std::vector<Real> Make(const Sampler& sampler, const SampleKey& key) {
  CameraSamples samples{Requests().layout};
  sampler.Generate(key, &samples);
  return Flatten(samples);
}

// Whether each of the strata of [0,1) holds exactly as many of the values as every other.
testing::AssertionResult IsStratified(const std::vector<Real>& values, int strata) {
  std::vector<int> counts(std::size_t(strata), 0);
  for (Real v : values) ++counts[std::size_t(double(v) * strata)];
  for (int count : counts) {
    if (count * strata != int(values.size()))
      return testing::AssertionFailure() << count << " values in one of " << strata << " strata";
  }
  return testing::AssertionSuccess();
}

testing::AssertionResult IsStratified(const std::vector<Point2>& points, int columns, int rows) {
  std::vector<Real> cells;
  for (Point2 p : points) {
    const int cell = int(double(p.x) * columns) + columns * int(double(p.y) * rows);
    cells.push_back(Real((cell + .5) / (columns * rows)));
  }
  return IsStratified(cells, columns * rows);
}

// Every way to cut the square into 2^k equal dyadic rectangles.
testing::AssertionResult IsNet(const std::vector<Point2>& points) {
  const int n = int(points.size());
  for (int columns = 1; columns <= n; columns *= 2) {
    auto result = IsStratified(points, columns, n / columns);
    if (!result) return result << " (" << columns << " columns)";
  }
  return testing::AssertionSuccess();
}

TEST(Sampler, ValuesLieInTheUnitInterval) {
  TestPlugins plugins;
  for (const char* text : kSamplers) {
    const auto sampler = plugins.MakeSampler(text);
    for (int i = 0; i < 400; ++i) {
      for (Real u : Make(*sampler, {3, {i % 20, i / 20}, i % 40})) {
        ASSERT_GE(u, 0) << text;
        ASSERT_LT(u, 1) << text;
      }
    }
  }
}

TEST(Sampler, TheSameKeyGivesTheSameBits) {
  TestPlugins plugins;
  for (const char* text : kSamplers) {
    const auto a = plugins.MakeSampler(text), b = plugins.MakeSampler(text);
    const SampleKey key{9, {100, 7}, 5};
    const std::vector<Real> first = Make(*a, key);
    Make(*a, {9, {101, 7}, 6});
    EXPECT_EQ(first, Make(*a, key)) << text;
    EXPECT_EQ(first, Make(*b, key)) << text;
  }
}

TEST(Sampler, ArraysDoNotDependOnTheOrderInWhichTheyAreRead) {
  TestPlugins plugins;
  for (const char* text : kSamplers) {
    const auto sampler = plugins.MakeSampler(text);
    CameraSamples samples{Requests().layout};
    const SampleKey key{4, {8, 2}, 3};
    sampler->Generate(key, &samples);
    for (int i = samples.Count2D() - 1; i >= 0; --i) samples.Array2D(i);
    for (int i = samples.Count1D() - 1; i >= 0; --i) samples.Array1D(i);
    EXPECT_EQ(Flatten(samples), Make(*sampler, key)) << text;
  }
}

class CountingSampler final : public Sampler {
 public:
  std::int64_t SamplesPerPixel() const override { return 1; }
  std::unique_ptr<Sampler> WithSamplesPerPixel(std::int64_t) const override { return nullptr; }
  std::uint64_t FillCamera(const SampleKey&, CameraSamples*) const override { return 7; }
  void Fill(std::uint64_t key, std::int64_t index, int request,
            std::span<Real> values) const override {
    filled.push_back({key, index, request, int(values.size())});
  }
  void Fill(std::uint64_t key, std::int64_t index, int request,
            std::span<Point2> values) const override {
    filled.push_back({key, index, request, int(values.size())});
  }
  using Call = std::tuple<std::uint64_t, std::int64_t, int, int>;
  mutable std::vector<Call> filled;
};

TEST(CameraSamples, AskForAnArrayOnceASampleAndOnlyIfItIsRead) {
  const CountingSampler sampler;
  SampleLayout layout;
  const int one = layout.Request1D(3), none = layout.Request1D(0), two = layout.Request2D(5);
  CameraSamples samples(layout);
  sampler.Generate({0, {0, 0}, 11}, &samples);
  EXPECT_TRUE(sampler.filled.empty());
  for (int i = 0; i < 2; ++i) {
    EXPECT_EQ(samples.Array2D(two).size(), 5u);
    EXPECT_TRUE(samples.Array1D(none).empty());
  }
  EXPECT_EQ(sampler.filled, (std::vector<CountingSampler::Call>{{7, 11, 2, 5}}));
  sampler.Generate({0, {0, 0}, 12}, &samples);
  samples.Array1D(one);
  samples.Array2D(two);
  EXPECT_EQ(sampler.filled,
            (std::vector<CountingSampler::Call>{{7, 11, 2, 5}, {7, 12, 0, 3}, {7, 12, 2, 5}}));
}

TEST(Sampler, OtherPointsDoNotDependOnWhetherLensAndTimeAreNeeded) {
  TestPlugins plugins;
  for (const char* text : kSamplers) {
    const auto sampler = plugins.MakeSampler(text);
    for (const bool needsLens : {false, true}) {
      SampleLayout layout = Requests().layout;
      layout.needsLens = needsLens;
      layout.needsTime = !needsLens;
      CameraSamples few(layout), all{Requests().layout};
      const SampleKey key{3, {5, 7}, 2};
      sampler->Generate(key, &few);
      sampler->Generate(key, &all);
      if (needsLens)
        EXPECT_EQ(few.lens, all.lens) << text;
      else
        EXPECT_EQ(few.time, all.time) << text;
      few.lens = all.lens, few.time = all.time;
      EXPECT_EQ(Flatten(few), Flatten(all)) << text;
    }
  }
}

TEST(Sampler, SeedsPixelsAndSamplesDiffer) {
  TestPlugins plugins;
  for (const char* text : kSamplers) {
    const auto sampler = plugins.MakeSampler(text);
    const std::vector<Real> base = Make(*sampler, {0, {3, 4}, 1});
    for (const SampleKey& key : {SampleKey{1, {3, 4}, 1}, SampleKey{0, {4, 3}, 1},
                                 SampleKey{0, {3, 4}, 2}, SampleKey{0, {3, 4}, 1ll << 40}}) {
      const std::vector<Real> other = Make(*sampler, key);
      std::size_t equal = 0;
      // Without jitter, film, lens and time have few values.
      for (std::size_t i = 5; i < base.size(); ++i) equal += base[i] == other[i];
      EXPECT_LE(equal, 1u) << text;
    }
  }
}

// Correlation of each pair of requests over many pixels, all at sample 0: nothing may repeat.
TEST(Sampler, RequestsAreUncorrelated) {
  TestPlugins plugins;
  constexpr int kPixels = 4000;
  for (const char* text : kSamplers) {
    const auto sampler = plugins.MakeSampler(text);
    std::vector<std::vector<double>> columns;
    for (int i = 0; i < kPixels; ++i) {
      const std::vector<Real> values = Make(*sampler, {1, {i, 2 * i + 1}, i % 16});
      columns.resize(values.size());
      for (std::size_t j = 0; j < values.size(); ++j) columns[j].push_back(double(values[j]) - .5);
    }
    // film, lens, time, the single 1D point, the first of eight, the single 2D point.
    const std::size_t chosen[] = {0, 1, 2, 3, 4, 5, 6, 21, 22};
    for (std::size_t a : chosen) {
      for (std::size_t b : chosen) {
        if (a >= b) continue;
        double sum = 0;
        for (std::size_t i = 0; i < kPixels; ++i) sum += columns[a][i] * columns[b][i];
        // Standard deviation 1/sqrt(n) of a correlation; 5 of them: 2e-5 in 144 tests.
        EXPECT_LT(std::abs(sum / kPixels * 12), 5 / std::sqrt(double(kPixels)))
            << text << " " << a << " " << b;
      }
    }
  }
}

// Within a stratum, too: where a sample lies in its cell says nothing of where it lies there along
// the other axis, nor in another request.
TEST(Sampler, PlacesWithinStrataAreUncorrelated) {
  TestPlugins plugins;
  constexpr int kPixels = 4000;
  for (const char* text : {kSamplers[0], kSamplers[1], kSamplers[3]}) {
    const auto sampler = plugins.MakeSampler(text);
    std::vector<std::vector<double>> columns;
    for (int i = 0; i < kPixels; ++i) {
      const std::vector<Real> values = Make(*sampler, {1, {i, 2 * i + 1}, i % 16});
      columns.resize(values.size());
      for (std::size_t j = 0; j < values.size(); ++j) {
        const double inCells = 4 * double(values[j]);
        columns[j].push_back(inCells - std::floor(inCells) - .5);
      }
    }
    // film, lens, the single 2D point.
    const std::size_t chosen[] = {0, 1, 2, 3, 21, 22};
    for (std::size_t a : chosen) {
      for (std::size_t b : chosen) {
        if (a >= b) continue;
        double sum = 0;
        for (std::size_t i = 0; i < kPixels; ++i) sum += columns[a][i] * columns[b][i];
        EXPECT_LT(std::abs(sum / kPixels * 12), 5 / std::sqrt(double(kPixels)))
            << text << " " << a << " " << b;
      }
    }
  }
}

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

// Whether film and lens fall into like halves: independent of one another from sample to sample, so
// that the mean over a pixel's 64 samples has the variance 1/4 / 64.
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
  // The variance of an estimated variance is about 2/n of its square; 5 deviations.
  EXPECT_NEAR(squares / kPixels * 4 * 64, 1, .07 + 5 * std::sqrt(2. / kPixels));
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

TEST(Sampler, OtherNumbersOfSamplesAreKept) {
  TestPlugins plugins;
  for (const char* text : {kSamplers[0], kSamplers[1]}) {
    for (std::int64_t count : {1, 2, 7, 64, 1 << 20}) {
      const auto sampler = plugins.MakeSampler(text)->WithSamplesPerPixel(count);
      EXPECT_EQ(sampler->SamplesPerPixel(), count);
      Make(*sampler, {0, {1, 1}, count - 1});
    }
  }
}

TEST(Sampler, CountsOutOfRangeAreErrors) {
  TestPlugins plugins;
  EXPECT_THROW(plugins.MakeSampler(R"("lowdiscrepancy" "integer pixelsamples" 0)"), Error);
  EXPECT_THROW(plugins.MakeSampler(R"("lowdiscrepancy" "integer pixelsamples" -4)"), Error);
  EXPECT_THROW(plugins.MakeSampler(R"("stratified" "integer xsamples" 0)"), Error);
  EXPECT_THROW(plugins.MakeSampler(R"("random" "integer ysamples" 0)"), Error);
}

}  // namespace
}  // namespace exphoton
