// SPDX-License-Identifier: BSD-2-Clause
// These tests check samplers of every kind: independence of seeds and requests, keys, and ranges.
// sampler_strata_test.cpp checks strata and nets.
#include "core/sampling/sampler.h"

#include <gtest/gtest.h>

#include <cmath>
#include <tuple>
#include <vector>

#include "core/base/error.h"
#include "tests/support/sampler_checks.h"
#include "tests/support/test_plugin.h"

namespace exphoton {
namespace {

TEST(Sampler, ValuesLieInTheUnitInterval) {
  TestPlugins plugins;
  for (const char* text : kSamplers) {
    const auto sampler = plugins.MakeSampler(text);
    for (int i = 0; i < 400; ++i) {
      for (Real u : MakeSamples(*sampler, {3, {i % 20, i / 20}, i % 40})) {
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
    const std::vector<Real> first = MakeSamples(*a, key);
    MakeSamples(*a, {9, {101, 7}, 6});
    EXPECT_EQ(first, MakeSamples(*a, key)) << text;
    EXPECT_EQ(first, MakeSamples(*b, key)) << text;
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
    EXPECT_EQ(Flatten(samples), MakeSamples(*sampler, key)) << text;
  }
}

TEST(Sampler, KnowsHowManySamplesAnotherCountBecomes) {
  TestPlugins plugins;
  for (const char* text : kSamplers) {
    const auto sampler = plugins.MakeSampler(text);
    for (const std::int64_t count : {1, 2, 3, 16, 134, 1000})
      EXPECT_EQ(sampler->RoundSamplesPerPixel(count),
                sampler->WithSamplesPerPixel(count)->SamplesPerPixel())
          << text << ' ' << count;
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
    const std::vector<Real> base = MakeSamples(*sampler, {0, {3, 4}, 1});
    for (const SampleKey& key :
         {SampleKey{1, {3, 4}, 1}, SampleKey{0, {4, 3}, 1}, SampleKey{0, {4, 4}, 1},
          SampleKey{0, {3, 5}, 1}, SampleKey{0, {3, 4}, 2}, SampleKey{0, {3, 4}, 1ll << 40}}) {
      const std::vector<Real> other = MakeSamples(*sampler, key);
      std::size_t equal = 0;
      // Without jitter, film, lens and time have few different values, so they are skipped.
      for (std::size_t i = 5; i < base.size(); ++i) equal += base[i] == other[i];
      EXPECT_LE(equal, 1u) << text;
    }
  }
}

// The test correlates each pair of requests over many pixels. No request may repeat another.
TEST(Sampler, RequestsAreUncorrelated) {
  TestPlugins plugins;
  for (const char* text : kSamplers) {
    const auto sampler = plugins.MakeSampler(text);
    const auto columns = Columns(*sampler, 4000, [](double value) { return value - .5; });
    // The columns are film, lens, time, the single 1D point, the first of eight, and the
    // single 2D point.
    EXPECT_TRUE(AreUncorrelated(columns, {0, 1, 2, 3, 4, 5, 6, 21, 22})) << text;
  }
}

// The position of a sample within its stratum must be uncorrelated with its position along the
// other axis and in other requests.
TEST(Sampler, PlacesWithinStrataAreUncorrelated) {
  TestPlugins plugins;
  for (const char* text : {kSamplers[0], kSamplers[1], kSamplers[3]}) {
    const auto sampler = plugins.MakeSampler(text);
    const auto columns = Columns(
        *sampler, 4000, [](double value) { return 4 * value - std::floor(4 * value) - .5; });
    // The columns are film, lens, and the single 2D point.
    EXPECT_TRUE(AreUncorrelated(columns, {0, 1, 2, 3, 21, 22})) << text;
  }
}

TEST(Sampler, OtherNumbersOfSamplesAreKept) {
  TestPlugins plugins;
  for (const char* text : {kSamplers[0], kSamplers[1]}) {
    for (std::int64_t count : {1, 2, 7, 64, 1 << 20}) {
      const auto sampler = plugins.MakeSampler(text)->WithSamplesPerPixel(count);
      EXPECT_EQ(sampler->SamplesPerPixel(), count);
      MakeSamples(*sampler, {0, {1, 1}, count - 1});
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

TEST(Sampler, DefaultsToFourSamples) {
  TestPlugins plugins;
  for (const char* name : {"random", "stratified", "lowdiscrepancy"})
    EXPECT_EQ(plugins.MakeSampler('"' + std::string(name) + '"')->SamplesPerPixel(), 4) << name;
  EXPECT_EQ(plugins.MakeSampler(R"("random" "integer xsamples" 3 "integer ysamples" 5)")
                ->SamplesPerPixel(),
            15);
  EXPECT_EQ(plugins.MakeSampler(R"("stratified" "integer xsamples" 3 "integer ysamples" 5)")
                ->SamplesPerPixel(),
            15);
}

}  // namespace
}  // namespace exphoton
