// SPDX-License-Identifier: BSD-2-Clause
// Random numbers are keyed by their purpose (seed, pixel or path, sample, dimension), so that no
// result depends on thread scheduling. Permutations are from Kensler 2013, "Correlated
// Multi-Jittered Sampling".
#pragma once

#include <cstdint>
#include <initializer_list>

#include "core/base/mix_bits.h"
#include "core/math/real.h"

namespace exphoton {

// Makes a key from a chain of integers. Different chains give independent keys.
constexpr std::uint64_t HashKey(std::initializer_list<std::uint64_t> parts) {
  std::uint64_t h = 0x9e3779b97f4a7c15ull;
  for (std::uint64_t part : parts) h = MixBits(h + 0x9e3779b97f4a7c15ull + MixBits(part + h));
  return h;
}

// Converts the upper bits to a Real in [0, kOneMinusEpsilon]. The result is never 1.
constexpr Real UniformFromBits(std::uint64_t bits) {
  if constexpr (sizeof(Real) == 4) {
    return Real(bits >> 40) * Real(1.0 / 16777216.0);
  } else {
    return Real(double(bits >> 11) * (1.0 / 9007199254740992.0));
  }
}

// RandomStream is a stream of uniform variates that its key fully determines (a SplitMix64
// counter).
class RandomStream {
 public:
  constexpr explicit RandomStream(std::uint64_t key) : state_(key) {}

  constexpr std::uint64_t Bits() {
    state_ += 0x9e3779b97f4a7c15ull;
    return MixBits(state_);
  }
  constexpr Real Uniform() { return UniformFromBits(Bits()); }

 private:
  std::uint64_t state_;
};

// Returns the image of index i of 0..length-1 under the permutation chosen by `key`. It needs no
// table and allows any length.
constexpr std::uint32_t PermuteIndex(std::uint32_t i, std::uint32_t length, std::uint32_t key) {
  if (length <= 1) return 0;
  if (length <= 16) {
    // The hash below is far from uniform for short lengths. Follow one index through the
    // Fisher-Yates shuffle instead.
    std::uint64_t state = MixBits(key + 0x9e3779b97f4a7c15ull);
    for (std::uint32_t k = length; k > 1; --k) {
      state = state * 6364136223846793005ull + 1442695040888963407ull;
      const auto j = static_cast<std::uint32_t>((state >> 32) * k >> 32);
      i = i == k - 1 ? j : i == j ? k - 1 : i;
    }
    return i;
  }
  std::uint32_t w = length - 1;
  w |= w >> 1;
  w |= w >> 2;
  w |= w >> 4;
  w |= w >> 8;
  w |= w >> 16;
  do {
    i ^= key;
    i *= 0xe170893du;
    i ^= key >> 16;
    i ^= (i & w) >> 4;
    i ^= key >> 8;
    i *= 0x0929eb3fu;
    i ^= key >> 23;
    i ^= (i & w) >> 1;
    i *= 1 | key >> 27;
    i *= 0x6935fa69u;
    i ^= (i & w) >> 11;
    i *= 0x74dcb303u;
    i ^= (i & w) >> 2;
    i *= 0x9e501cc3u;
    i ^= (i & w) >> 2;
    i *= 0xc860a3dfu;
    i &= w;
    i ^= i >> 5;
  } while (i >= length);
  return static_cast<std::uint32_t>((std::uint64_t(i) + key) % length);
}

// Permutes all of 0..N-1, N <= 16: to[i] = PermuteIndex(i, N, key).
template <std::size_t N>
constexpr void PermuteAll(std::uint32_t key, std::uint8_t (&to)[N]) {
  static_assert(N > 1 && N <= 16);
  std::uint8_t at[N] = {};  // the index that is now at each place
  for (std::size_t i = 0; i < N; ++i) at[i] = std::uint8_t(i);
  std::uint64_t state = MixBits(key + 0x9e3779b97f4a7c15ull);
  for (std::uint32_t k = N; k > 1; --k) {
    state = state * 6364136223846793005ull + 1442695040888963407ull;
    const auto j = static_cast<std::uint32_t>((state >> 32) * k >> 32);
    const std::uint8_t moved = at[k - 1];
    at[k - 1] = at[j];
    at[j] = moved;
  }
  for (std::size_t i = 0; i < N; ++i) to[at[i]] = std::uint8_t(i);
}

}  // namespace exphoton
