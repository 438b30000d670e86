// SPDX-License-Identifier: BSD-2-Clause
// PathSamples: the random numbers of photon path i. Light choice, emission and first bounce take
// the i-th point of padded Owen-scrambled (0,2)-sequences, each pair with its own order of the
// points (Burley 2020: Owen's scrambling of the index itself, so that aligned blocks of 2^m indices
// stay such blocks; and of the sixteen of a block before it, as that alone keeps neighbours
// together in every pair). Everything after that is an independent stream. Indices are 64-bit:
// beyond 2^32 the sequences start again with other keys.
#pragma once

#include "core/math/low_discrepancy.h"
#include "core/math/random.h"

namespace exphoton {

class PathSamples {
 public:
  PathSamples(std::uint64_t seed, std::uint64_t path)
      : index_(std::uint32_t(path)),
        key_(HashKey({seed, kSequenceKey, path >> 32})),
        stream_(HashKey({seed, kStreamKey, path})) {}

  // The next pair: of the sequences while there are any left, then of the stream.
  Point2 Next2D() {
    if (pair_ == kSequencePairs) {
      const Real x = stream_.Uniform();
      return {x, stream_.Uniform()};
    }
    const std::uint64_t key = HashKey({key_, std::uint64_t(pair_++)});
    return ScrambledSobol2(Shuffled(key), key);
  }
  // In [0,1): when the photon is under way. Well distributed over the paths, and of its own: with it
  // or without, all other numbers are the same.
  Real Time() const {
    const std::uint64_t key = HashKey({key_, kTimeKey});
    return ScrambledVanDerCorput(Shuffled(key), std::uint32_t(key));
  }
  // From the stream at once.
  Real Independent() { return stream_.Uniform(); }

 private:
  static constexpr int kSequencePairs = 5;  // light, position, direction, bounce, lobe and roulette
  static constexpr std::uint32_t kShuffled = 16;  // a power of two
  static constexpr std::uint64_t kSequenceKey = 0x70686f746f6e31ull;
  static constexpr std::uint64_t kStreamKey = 0x70686f746f6e32ull;
  static constexpr std::uint64_t kTimeKey = 0x70686f746f6e33ull;

  // A pair's own order of the points, or the pairs would be functions of each other.
  std::uint32_t Shuffled(std::uint64_t key) const {
    const std::uint64_t shuffleKey = MixBits(key);
    const std::uint32_t low = index_ & (kShuffled - 1);
    const std::uint32_t permuted =
        index_ - low + PermuteIndex(low, kShuffled, std::uint32_t(shuffleKey >> 32));
    return OwenScramble(permuted, std::uint32_t(shuffleKey));
  }

  std::uint32_t index_;
  std::uint64_t key_;
  RandomStream stream_;
  int pair_ = 0;
};

}  // namespace exphoton
