// SPDX-License-Identifier: BSD-2-Clause
// CheckSampler: the samples of some pixels, with arrays of several sizes.
#include "core/app/checks/sampler_checks.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/app/checks/chi_square.h"
#include "core/math/sampling/random.h"

namespace exphoton {
namespace {

constexpr int kPixels = 200;  // along a diagonal that leaves the tiles

class SamplerChecker {
 public:
  SamplerChecker(const Sampler& sampler, std::uint64_t seed)
      : sampler_(sampler),
        seed_(seed),
        count_(std::clamp<std::int64_t>(sampler.SamplesPerPixel(), 1, 256)) {
    for (const int size : {1, 5}) {
      layout_.Request1D(sampler.RoundCount(size));
      layout_.Request2D(sampler.RoundCount(size));
    }
  }

  Checks Run() {
    CheckRange();
    CheckOrder();
    CheckRepetition();
    CheckUniformity();
    CheckStrata();
    return std::move(checks_);
  }

 private:
  static Point2i PixelAt(int i) { return {7 * i, 3 * i + i % 5}; }

  // Returns all numbers of a sample: film, lens, time, and the arrays, whose order of reading may
  // be reversed.
  std::vector<Real> Numbers(const SampleKey& key, CameraSamples* samples, bool isReversed) const {
    sampler_.Generate(key, samples);
    std::vector<std::vector<Real>> arrays(std::size_t(samples->Count1D() + samples->Count2D()));
    for (std::size_t at = 0; at < arrays.size(); ++at) {
      const std::size_t i = isReversed ? arrays.size() - 1 - at : at;
      const int handle = int(i) - samples->Count1D();
      if (handle < 0)
        for (const Real u : samples->Array1D(int(i))) arrays[i].push_back(u);
      else
        for (const Point2 u : samples->Array2D(handle))
          arrays[i].insert(arrays[i].end(), {u.x, u.y});
    }
    std::vector<Real> all{samples->film.x, samples->film.y, samples->lens.x, samples->lens.y,
                          samples->time};
    for (const auto& array : arrays) all.insert(all.end(), array.begin(), array.end());
    return all;
  }

  std::vector<Real> Numbers(const SampleKey& key) const {
    CameraSamples samples(layout_);
    return Numbers(key, &samples, false);
  }

  void CheckRange() {
    int outside = 0;
    for (int i = 0; i < kPixels; ++i)
      for (const Real u : Numbers({seed_, PixelAt(i), i % count_})) outside += !(u >= 0 && u < 1);
    checks_.AtMost("range", outside, 0, "numbers outside of [0, 1)");
  }

  // The same sample again, after others, with arrays that are read in reverse, by another object.
  void CheckOrder() {
    CameraSamples used(layout_);
    int different = 0;
    for (int i = kPixels - 1; i >= 0; --i) {
      const SampleKey key{seed_, PixelAt(i), i % count_};
      different += Numbers(key, &used, true) != Numbers(key);
    }
    checks_.AtMost("order", different, 0, "samples that depend on earlier ones");
  }

  // Samples with other keys must have other numbers: of the pixel, of its neighbours, and of the
  // same pixel with another seed.
  void CheckRepetition() {
    int repeated = 0;
    for (int i = 0; i < kPixels; ++i) {
      const Point2i pixel = PixelAt(i);
      const std::vector<Real> one = Numbers({seed_, pixel, 0});
      for (const SampleKey& other :
           {SampleKey{seed_, {pixel.x + 1, pixel.y}, 0},
            SampleKey{seed_, {pixel.x, pixel.y + 1}, 0}, SampleKey{seed_ + 1, pixel, 0}})
        repeated += Numbers(other) == one;
      if (count_ > 1) repeated += Numbers({seed_, pixel, 1 + i % (count_ - 1)}) == one;
    }
    checks_.AtMost("repetition", repeated, 0, "samples equal to those of other keys");
  }

  // Points over many pixels, one sample of each, so that they are independent: the film, the lens,
  // the time, and a point of each array. Points of one array may be strata, so any of them counts.
  void CheckUniformity() {
    ChiSquareOptions options;
    options.rows = options.columns = 8;
    options.samples = 4000;
    const int quantities = 3 + int(layout_.Counts1D().size() + layout_.Counts2D().size());
    double least = 1;
    for (int quantity = 0; quantity < quantities; ++quantity) {
      int pixel = 0;
      const auto sample = [&](RandomStream& random) -> std::optional<Point2> {
        const Point2i at{pixel % 64, pixel / 64};
        ++pixel;
        return PointOf(quantity, at, &random);
      };
      least = std::min(least, TestPlane(
                                  {}, sample, [](Point2) { return 1.; }, options)
                                  .pValue);
    }
    checks_.AtLeast("uniformity", least, SignificanceOf(kFalseAlarms, quantities),
                    "p-value of points over pixels");
  }

  // Single numbers are paired with random ones.
  Point2 PointOf(int quantity, Point2i pixel, RandomStream* random) const {
    const auto below = [&](std::int64_t count) {
      return std::min(std::int64_t(random->Uniform() * Real(count)), count - 1);
    };
    CameraSamples samples(layout_);
    sampler_.Generate({seed_, pixel, below(count_)}, &samples);
    if (quantity == 0) return samples.film;
    if (quantity == 1) return samples.lens;
    if (quantity == 2) return {samples.time, random->Uniform()};
    const int handle = quantity - 3;
    if (handle < samples.Count1D()) {
      const auto array = samples.Array1D(handle);
      return {array[std::size_t(below(std::int64_t(array.size())))], random->Uniform()};
    }
    const auto array = samples.Array2D(handle - samples.Count1D());
    return array[std::size_t(below(std::int64_t(array.size())))];
  }

  // The variance of a pixel's mean of film.x, over the variance with independent samples.
  void CheckStrata() {
    if (count_ < 2) return checks_.notes.push_back("one sample a pixel: strata are not checked");
    double squares = 0;
    for (int i = 0; i < kPixels; ++i) {
      double sum = 0;
      for (std::int64_t k = 0; k < count_; ++k) sum += double(Numbers({seed_, PixelAt(i), k})[0]);
      squares += (sum / double(count_) - .5) * (sum / double(count_) - .5) / kPixels;
    }
    // 1 for independent samples, with a standard deviation of 0.1 for 200 pixels.
    checks_.AtMost("strata", squares * 12 * double(count_), 1.4,
                   "variance of a pixel's mean over random's");
  }

  const Sampler& sampler_;
  std::uint64_t seed_;
  std::int64_t count_;
  SampleLayout layout_;
  Checks checks_;
};

}  // namespace

Checks CheckSampler(const Sampler& sampler, std::uint64_t seed) {
  return SamplerChecker(sampler, seed).Run();
}

}  // namespace exphoton
