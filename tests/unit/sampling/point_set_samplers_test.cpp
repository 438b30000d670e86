// SPDX-License-Identifier: BSD-2-Clause
// These tests check the samplers "halton" and "bestcandidate": strata in the bases 2 and 3,
// distances between points, and uniform points over pixels.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "core/base/error.h"
#include "core/sampling/sampler.h"
#include "tests/support/sampler_checks.h"
#include "tests/support/test_plugin.h"

namespace exphoton {
namespace {

struct PixelPoints {
  std::vector<Point2> film, lens, array;
  std::vector<Real> time;
};

PixelPoints PointsOf(const Sampler& sampler, std::uint64_t seed, int count) {
  const Requests r;
  PixelPoints points;
  for (int i = 0; i < count; ++i) {
    CameraSamples s{r.layout};
    sampler.Generate({seed, {3, 8}, i}, &s);
    points.film.push_back(s.film), points.lens.push_back(s.lens), points.time.push_back(s.time);
    for (const Point2 p : s.Array2D(r.sixteen2)) points.array.push_back(p);
  }
  return points;
}

TEST(HaltonSampler, IsStratifiedInBothBases) {
  TestPlugins plugins;
  const auto sampler = plugins.MakeSampler(R"("halton" "integer pixelsamples" 36)");
  EXPECT_EQ(sampler->SamplesPerPixel(), 36);
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const PixelPoints points = PointsOf(*sampler, seed, 36);
    for (const auto& set : {points.film, points.lens}) EXPECT_TRUE(IsStratified(set, 4, 9));
    EXPECT_TRUE(IsStratified(points.array, 64, 9));  // 576 points
    std::vector<Real> first32(points.time.begin(), points.time.end());
    EXPECT_TRUE(IsStratified(first32, 4));
  }
  // Samples beyond the stated number begin another round of the sequence.
  const auto one = sampler->WithSamplesPerPixel(6);
  std::vector<Point2> film = PointsOf(*one, 1, 36).film;
  EXPECT_TRUE(IsStratified(film, 4, 9));
}

double LeastDistance(const std::vector<Point2>& points) {
  double least = 2;
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const double dx = std::abs(double(points[i].x - points[j].x));
      const double dy = std::abs(double(points[i].y - points[j].y));
      least = std::min(least, std::hypot(std::min(dx, 1 - dx), std::min(dy, 1 - dy)));
    }
  }
  return least;
}

TEST(BestCandidateSampler, KeepsItsPointsApart) {
  TestPlugins plugins;
  for (const int count : {4, 64}) {
    const auto sampler = plugins.MakeSampler(R"("bestcandidate")")->WithSamplesPerPixel(count);
    EXPECT_EQ(sampler->SamplesPerPixel(), count);
    for (std::uint64_t seed = 0; seed < 10; ++seed) {
      const PixelPoints points = PointsOf(*sampler, seed, count);
      // The densest packing has the distance 1.07 / sqrt(count). Random points come as near as
      // about 1 / count.
      EXPECT_GT(LeastDistance(points.film), .6 / std::sqrt(count));
      EXPECT_GT(LeastDistance(points.lens), .6 / std::sqrt(count));
    }
  }
  EXPECT_EQ(plugins.MakeSampler(R"("bestcandidate")")->SamplesPerPixel(), 4);
}

// Over many seeds, every sample is uniform, and film and lens points are independent.
TEST(BestCandidateSampler, IsUniformOverSeeds) {
  TestPlugins plugins;
  const auto sampler = plugins.MakeSampler(R"("bestcandidate" "integer pixelsamples" 3)");
  constexpr int kSeeds = 4000, kSide = 4;
  std::vector<int> film(kSide * kSide), both(kSide * kSide);
  const auto cell = [](Real x) { return std::size_t(x * kSide); };
  for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
    CameraSamples s{SampleLayout{}};
    sampler->Generate({seed, {1, 2}, 4}, &s);  // a sample of the second pattern
    ++film[cell(s.film.x) * kSide + cell(s.film.y)];
    ++both[cell(s.film.x) * kSide + cell(s.lens.x)];
  }
  const double expected = double(kSeeds) / (kSide * kSide);
  for (const auto& counts : {film, both})
    for (const int count : counts) EXPECT_NEAR(count, expected, 5 * std::sqrt(expected));
}

TEST(PointSetSamplers, RefuseZeroSamples) {
  TestPlugins plugins;
  EXPECT_THROW(plugins.MakeSampler(R"("halton" "integer pixelsamples" 0)"), Error);
  EXPECT_THROW(plugins.MakeSampler(R"("bestcandidate" "integer pixelsamples" 0)"), Error);
}

}  // namespace
}  // namespace exphoton
