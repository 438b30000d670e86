// SPDX-License-Identifier: BSD-2-Clause
// PhotonPathSampler generates the random numbers of photon path i. Light choice, emission and first
// bounce use point i of padded Owen-scrambled (0,2)-sequences (Burley 2020). All later numbers come
// from an independent stream. Beyond 2^32 paths the sequences restart with other keys (indices are
// 64-bit).
#pragma once

#include "core/math/sampling/low_discrepancy.h"
#include "core/math/sampling/random.h"

namespace exphoton {

// PhotonPathSequences holds the data shared by all paths of one period of the sequences (2^32 path
// indices, aligned).
class PhotonPathSequences {
 public:
  // `path` is any path index of the period.
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

  // Each pair has its own order of the points, or the pairs would be functions of each other. Owen
  // scrambling of the index keeps aligned blocks of 2^m indices together. Alone it would keep
  // neighbours together in every pair, so indices are first permuted within blocks of sixteen.
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
  // The sequences must be those of the path's period and outlive this object.
  PhotonPathSampler(const PhotonPathSequences& sequences, std::uint64_t path)
      : sequences_(sequences),
        index_(std::uint32_t(path)),
        stream_(HashKey({sequences.Seed(), kStreamKey, path})) {}

  // Returns the next pair, from the sequences while any are left, then from the stream.
  Point2 Next2D() {
    if (pair_ == PhotonPathSequences::kPairs) return IndependentPair();
    return sequences_.Pair(pair_++, index_);
  }
  // Returns the time of the photon in [0,1), well distributed over the paths. All other numbers are
  // the same whether or not it is called.
  Real Time() const { return sequences_.Time(index_); }
  // Always takes a number from the stream.
  Real Independent() { return stream_.Uniform(); }
  Point2 IndependentPair() {
    const Real x = stream_.Uniform();
    return {x, stream_.Uniform()};
  }

 private:
  static constexpr std::uint64_t kStreamKey = 0x70686f746f6e32ull;

  const PhotonPathSequences& sequences_;
  std::uint32_t index_;
  RandomStream stream_;
  int pair_ = 0;
};

}  // namespace exphoton
