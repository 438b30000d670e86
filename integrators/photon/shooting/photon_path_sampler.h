// SPDX-License-Identifier: BSD-2-Clause
// PhotonPathSampler: the random numbers of photon path i. Light choice, emission and first bounce
// take the i-th point of padded Owen-scrambled (0,2)-sequences, each pair with its own order of the
// points (Burley 2020: Owen's scrambling of the index itself, so that aligned blocks of 2^m indices
// stay such blocks; and of the sixteen of a block before it, as that alone keeps neighbours
// together in every pair). Everything after that is an independent stream. Indices are 64-bit:
// beyond 2^32 the sequences start again with other keys.
#pragma once

#include "core/math/sampling/low_discrepancy.h"
#include "core/math/sampling/random.h"

namespace exphoton {

// What all paths of one period of the sequences (2^32 paths, aligned) have in common.
class PhotonPathSequences {
 public:
  // `path` is any of the period.
  PhotonPathSequences(std::uint64_t seed, std::uint64_t path) : seed_(seed), period_(path >> 32) {
    const std::uint64_t key = HashKey({seed, kSequenceKey, period_});
    for (int i = 0; i < kPairs; ++i) orders_[i] = Order(HashKey({key, std::uint64_t(i)}));
    time_ = Order(HashKey({key, kTimeKey}));
  }

  static constexpr int kPairs = 5;  // light, position, direction, bounce, lobe and roulette

  std::uint64_t Seed() const { return seed_; }
  std::uint64_t Period() const { return period_; }
  Point2 Pair(int pair, std::uint32_t index) const {
    return ScrambledSobol2(orders_[pair].Shuffled(index), orders_[pair].key);
  }
  Real Time(std::uint32_t index) const {
    return ScrambledVanDerCorput(time_.Shuffled(index), std::uint32_t(time_.key));
  }

 private:
  static constexpr std::uint32_t kShuffled = 16;  // a power of two
  static constexpr std::uint64_t kSequenceKey = 0x70686f746f6e31ull;
  static constexpr std::uint64_t kTimeKey = 0x70686f746f6e33ull;

  // A pair's own order of the points, or the pairs would be functions of each other.
  struct Order {
    Order() = default;
    explicit Order(std::uint64_t ofPair) : key(ofPair) {
      const std::uint64_t shuffleKey = MixBits(key);
      scramble = std::uint32_t(shuffleKey);
      PermuteAll(std::uint32_t(shuffleKey >> 32), within);
    }
    std::uint32_t Shuffled(std::uint32_t index) const {
      const std::uint32_t low = index & (kShuffled - 1);
      return OwenScramble(index - low + within[low], scramble);
    }

    std::uint64_t key = 0;
    std::uint32_t scramble = 0;
    std::uint8_t within[kShuffled] = {};
  };

  std::uint64_t seed_, period_;
  Order orders_[kPairs], time_;
};

class PhotonPathSampler {
 public:
  // The sequences are of the path's period, and must outlive this.
  PhotonPathSampler(const PhotonPathSequences& sequences, std::uint64_t path)
      : sequences_(sequences),
        index_(std::uint32_t(path)),
        stream_(HashKey({sequences.Seed(), kStreamKey, path})) {}

  // The next pair: of the sequences while there are any left, then of the stream.
  Point2 Next2D() {
    if (pair_ == PhotonPathSequences::kPairs) {
      const Real x = stream_.Uniform();
      return {x, stream_.Uniform()};
    }
    return sequences_.Pair(pair_++, index_);
  }
  // In [0,1): when the photon is under way. Well distributed over the paths, and of its own: with
  // it or without, all other numbers are the same.
  Real Time() const { return sequences_.Time(index_); }
  // From the stream at once.
  Real Independent() { return stream_.Uniform(); }

 private:
  static constexpr std::uint64_t kStreamKey = 0x70686f746f6e32ull;

  const PhotonPathSequences& sequences_;
  std::uint32_t index_;
  RandomStream stream_;
  int pair_ = 0;
};

}  // namespace exphoton
