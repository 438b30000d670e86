// SPDX-License-Identifier: BSD-2-Clause
// HaltonPoints makes the points of one request of a sampler: runs of the Halton sequence in the
// bases 2 and 3, scrambled by a key. The samples of a pixel take the runs in an order of their own
// for each request, so that requests do not correlate. Source: Halton 1960; Owen 1995 (scrambling).
#pragma once

#include <span>
#include <utility>

#include "core/math/sampling/low_discrepancy.h"

namespace exphoton {

class HaltonPoints {
 public:
  // `key` is a hash of (seed, pixel, request). `samples` is the number of samples of the pixel.
  HaltonPoints(std::uint64_t key, std::int64_t sample, std::int64_t samples) : key_(MixBits(key)) {
    const std::int64_t round = sample / samples, index = sample % samples;
    run_ = std::uint64_t(round * samples) +
           PermuteIndex(std::uint32_t(index), std::uint32_t(samples), std::uint32_t(key_ >> 32));
  }

  Real First(std::uint64_t point = 0, std::uint64_t count = 1) const {
    return ScrambledRadicalInverse(2, run_ * count + point, key_);
  }
  Point2 Both(std::uint64_t point = 0, std::uint64_t count = 1) const {
    return {First(point, count),
            ScrambledRadicalInverse(3, run_ * count + point, key_ + 0x9e3779b97f4a7c15ull)};
  }

  // Fills an array with one run of the sequence, in random order.
  void Fill(std::span<Real> values) const {
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = First(i, values.size());
    Shuffle(values);
  }
  void Fill(std::span<Point2> values) const {
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = Both(i, values.size());
    Shuffle(values);
  }

 private:
  template <class T>
  void Shuffle(std::span<T> values) const {
    RandomStream random(MixBits(key_ + MixBits(run_)));
    for (std::size_t i = values.size(); i > 1; --i)
      std::swap(values[i - 1], values[(random.Bits() >> 32) * i >> 32]);
  }

  std::uint64_t key_, run_;
};

}  // namespace exphoton
