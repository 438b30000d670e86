// SPDX-License-Identifier: BSD-2-Clause
// LowDiscrepancySampler uses an Owen-scrambled (0,2)-sequence for each pixel and request, shuffled
// so that requests do not correlate. Any array of 2^k points, the first 2^k samples (k >= 4) and
// all samples of a pixel are (0,k,2)-nets. The samplers "lowdiscrepancy" and "adaptive" use it.
// Sources: Kollig and Keller 2002; Burley 2020, "Practical Hash-based Owen Scrambling".
#pragma once

#include <array>
#include <bit>
#include <utility>

#include "core/math/sampling/batched_owen_scrambling.h"
#include "core/math/sampling/low_discrepancy.h"
#include "core/plugin.h"

namespace exphoton::low_discrepancy {

inline constexpr std::uint64_t kGolden = 0x9e3779b97f4a7c15ull;
inline constexpr int kMaxCount = 1 << 30;
// This many consecutive samples are shuffled freely. A shuffle that kept every pair of samples
// together would double the variance of the interaction of two requests.
inline constexpr std::uint32_t kShuffled = 16;

// Below, all values are bit-reversed until the last step. Bit-reversed, the first dimension is the
// index itself.
constexpr std::array<std::uint32_t, 32> ReversedDirections() {
  std::array<std::uint32_t, 32> directions{};
  for (std::size_t k = 0; k < 32; ++k) directions[k] = SobolSecondReversed(1u << k);
  return directions;
}
inline constexpr std::array<std::uint32_t, 32> kDirections = ReversedDirections();

// Block generates the points of one request at one sample: an aligned block of 2^k points of the
// sequence, or a random choice of these. Gray code order needs one exclusive-or per point.
class Block {
 public:
  // `requestKey` is a hash of (seed, pixel, request). `shuffled` is a power of two.
  Block(std::uint64_t requestKey, std::int64_t sample, std::uint32_t shuffled, std::size_t count)
      : key_(MixBits(requestKey)) {
    const int shift = int(std::bit_width(count == 0 ? 0 : count - 1));
    const std::uint64_t shuffleKey = MixBits(key_ + kGolden);
    const auto low = std::uint32_t(sample) & (shuffled - 1);
    const std::uint64_t s =
        std::uint64_t(sample) - low + PermuteIndex(low, shuffled, std::uint32_t(shuffleKey >> 32));
    // Beyond 2^32 points the sequence restarts with other keys.
    const std::uint64_t round = s >> (32 - shift);
    if (round != 0) key_ = MixBits(key_ + kGolden * round);
    const auto first = static_cast<std::uint32_t>(s << shift);
    index_ = OwenScramble(first, std::uint32_t(shuffleKey)) >> shift << shift;
    // Fewer points than a block leave some of it out. Each sample must leave out others, because a
    // pixel would otherwise never see a part of the domain.
    if (count > 0 && !std::has_single_bit(count))
      index_ |= std::uint32_t(MixBits(key_ ^ MixBits(s + 1)) >> (64 - shift));
    second_ = SobolSecondReversed(index_);
  }

  // Returns the first point of a 1D request, which may be the only one.
  Real First() const { return ScrambledVanDerCorput(index_, FirstKey()); }
  Point2 Both() const { return {First(), ScrambledVanDerCorput(second_, SecondKey())}; }

  // Generates the next run of points. `number` is the index of its first point. Runs must be
  // generated in order.
  void Next(std::span<Real> values, std::uint32_t number) {
    std::uint32_t first[kRun] = {};
    for (std::size_t i = 0; i < values.size(); ++i) {
      first[i] = index_;
      index_ ^= 1u << std::countr_one(number + std::uint32_t(i));
    }
    BatchedOwenScrambling(first, values.size(), FirstKey(), values.data());
  }
  void Next(std::span<Point2> values, std::uint32_t number) {
    std::uint32_t second[kRun];
    Real x[kRun], y[kRun];
    for (std::size_t i = 0; i < values.size(); ++i) {
      second[i] = second_;
      second_ ^= kDirections[std::size_t(std::countr_one(number + std::uint32_t(i)))];
    }
    Next({x, values.size()}, number);
    BatchedOwenScrambling(second, values.size(), SecondKey(), y);
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = {x[i], y[i]};
  }

  static constexpr std::size_t kRun = 64;  // most points per run

 private:
  std::uint32_t FirstKey() const { return std::uint32_t(key_); }
  std::uint32_t SecondKey() const { return std::uint32_t(key_ >> 32); }

  std::uint64_t key_;
  std::uint32_t index_, second_;
};

// Makes all orders equally likely, so that the i-th points of two arrays are independent.
template <class T>
void Shuffle(std::span<T> values, std::uint64_t key) {
  RandomStream random(key);
  for (std::size_t i = values.size(); i > 1; --i) {
    const std::size_t j = (random.Bits() >> 32) * i >> 32;
    std::swap(values[i - 1], values[j]);
  }
}

class LowDiscrepancySampler final : public Sampler {
 public:
  explicit LowDiscrepancySampler(std::int64_t count)
      : count_(count), shuffled_(count < kShuffled ? std::uint32_t(count) : kShuffled) {}

  std::int64_t SamplesPerPixel() const override { return count_; }
  int RoundCount(int count) const override {
    return count <= 1 ? 1 : int(std::bit_ceil(unsigned(std::min(count, kMaxCount))));
  }
  bool IsProgressive() const override { return true; }
  std::unique_ptr<Sampler> WithSamplesPerPixel(std::int64_t count) const override {
    return std::make_unique<LowDiscrepancySampler>(RoundSamplesPerPixel(count));
  }
  std::int64_t RoundSamplesPerPixel(std::int64_t count) const override {
    return std::int64_t(std::bit_ceil(std::uint64_t(std::max<std::int64_t>(count, 1))));
  }

  std::uint64_t FillCamera(const SampleKey& key, CameraSamples* samples) const override {
    const std::uint64_t pixelKey =
        HashKey({key.seed, std::uint64_t(key.pixel.x), std::uint64_t(key.pixel.y), 0x6c6f7764});
    const auto block = [&](std::uint64_t request) {
      return Block(pixelKey + kGolden * request, key.index, shuffled_, 1);
    };
    samples->film = block(1).Both();
    if (samples->NeedsLens()) samples->lens = block(2).Both();
    if (samples->NeedsTime()) samples->time = block(3).First();
    return pixelKey;
  }
  void Fill(std::uint64_t pixelKey, std::int64_t index, int request,
            std::span<Real> values) const override {
    FillArray(pixelKey, index, request, values);
  }
  void Fill(std::uint64_t pixelKey, std::int64_t index, int request,
            std::span<Point2> values) const override {
    FillArray(pixelKey, index, request, values);
  }

 private:
  template <class T>
  void FillArray(std::uint64_t pixelKey, std::int64_t sample, int number,
                 std::span<T> values) const {
    const std::uint64_t request = pixelKey + kGolden * (kFirstArray + std::uint64_t(number));
    Block block(request, sample, shuffled_, values.size());
    for (std::size_t k = 0; k < values.size(); k += Block::kRun)
      block.Next(values.subspan(k, std::min(Block::kRun, values.size() - k)), std::uint32_t(k));
    if (values.size() > 1)
      Shuffle(values, MixBits(request + MixBits(std::uint64_t(sample) + kGolden)));
  }

  static constexpr std::uint64_t kFirstArray = 4;  // after film, lens and time

  std::int64_t count_;
  std::uint32_t shuffled_;
};

}  // namespace exphoton::low_discrepancy
