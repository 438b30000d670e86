// SPDX-License-Identifier: BSD-2-Clause
// The sampler "bestcandidate" places the film and lens points of a pixel far from each other: each
// new point is the one of several random candidates that is farthest from all points before it
// (Mitchell 1991). Distances are measured on a torus, so that each pixel can move the pattern by a
// random vector. This makes every point uniform. Time and arrays are scrambled Halton points.
#include <algorithm>
#include <cmath>

#include "samplers/common/halton_sampler.h"

namespace exphoton {
namespace {

constexpr std::int64_t kPatternSize = 1024;  // samples beyond it begin a pattern moved elsewhere

using Settings = PixelSamplesSettings;

const ParamTable<Settings>& Parameters() { return PixelSamplesParameters(); }

double TorusDistance2(Point2 a, Point2 b) {
  const auto along = [](Real x, Real y) {
    const double d = std::abs(double(x) - double(y));
    return std::min(d, 1 - d);
  };
  const double dx = along(a.x, b.x), dy = along(a.y, b.y);
  return dx * dx + dy * dy;
}

// Returns `count` points of the unit torus in the order in which they were chosen.
std::vector<Point2> MakePattern(std::int64_t count, std::uint64_t key) {
  // Mitchell lets the number of candidates grow with the points. A fixed number is nearly as good
  // and keeps the work for 1024 points below a tenth of a second.
  constexpr int kCandidates = 32;
  RandomStream random(key);
  std::vector<Point2> points;
  while (std::int64_t(points.size()) < count) {
    Point2 best;
    double farthest2 = -1;
    for (int i = 0; i < (points.empty() ? 1 : kCandidates); ++i) {
      const Real x = random.Uniform();
      const Point2 candidate(x, random.Uniform());
      double nearest2 = 2;
      for (const Point2& point : points)
        nearest2 = std::min(nearest2, TorusDistance2(candidate, point));
      if (nearest2 > farthest2) farthest2 = nearest2, best = candidate;
    }
    points.push_back(best);
  }
  return points;
}

Point2 MovedOnTorus(Point2 point, Point2 by) {
  const auto along = [](Real x, Real shift) {
    const Real sum = x + shift;
    return std::min(sum < 1 ? sum : sum - 1, kOneMinusEpsilon);
  };
  return {along(point.x, by.x), along(point.y, by.y)};
}

class BestCandidateSampler final : public HaltonArraySampler<BestCandidateSampler> {
 public:
  explicit BestCandidateSampler(std::int64_t count)
      : HaltonArraySampler(count),
        film_(MakePattern(std::min(count, kPatternSize), 0x66696c6d)),
        lens_(MakePattern(std::min(count, kPatternSize), 0x6c656e73)) {}

  std::uint64_t FillCamera(const SampleKey& key, CameraSamples* samples) const override {
    const std::uint64_t pixelKey =
        HashKey({key.seed, std::uint64_t(key.pixel.x), std::uint64_t(key.pixel.y), 0x62657374});
    samples->film = PatternPoint(film_, pixelKey, key.index, kFilm);
    if (samples->NeedsLens()) samples->lens = PatternPoint(lens_, pixelKey, key.index, kLens);
    if (samples->NeedsTime()) samples->time = Points(pixelKey, key.index, kTime).First();
    return pixelKey;
  }

 private:
  // Returns a point of the pattern, moved by the pixel's vector. The pixel takes the pattern's
  // points in an order of its own, so that film and lens points do not correlate.
  static Point2 PatternPoint(const std::vector<Point2>& pattern, std::uint64_t pixelKey,
                             std::int64_t sample, int request) {
    const auto size = std::int64_t(pattern.size());
    const std::uint64_t key =
        HashKey({pixelKey, std::uint64_t(request), std::uint64_t(sample / size)});
    RandomStream random(key);
    const Real x = random.Uniform();
    const Point2 shift(x, random.Uniform());
    const std::uint32_t place = PermuteIndex(std::uint32_t(sample % size), std::uint32_t(size),
                                             std::uint32_t(random.Bits() >> 32));
    return MovedOnTorus(pattern[place], shift);
  }

  std::vector<Point2> film_, lens_;
};

std::unique_ptr<Sampler> Create(const Settings& settings, const SamplerContext&) {
  return std::make_unique<BestCandidateSampler>(settings.pixelSamples);
}

}  // namespace
}  // namespace exphoton

EXPHOTON_SAMPLER("bestcandidate", "points far from each other")
