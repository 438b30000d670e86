// SPDX-License-Identifier: BSD-2-Clause
// Low-discrepancy points with keyed randomisation and 64-bit indices.
//   (0,2)-sequence: first two Sobol' dimensions, Owen-scrambled by hashing
//     (Laine and Karras 2011; Burley 2020, "Practical Hash-based Owen Scrambling").
//   Halton: radical inverses with Owen-scrambled (position- and prefix-dependent) digits
//     (Owen 1995; Faure and Tezuka 2002 for the plain permutations).
#pragma once

#include <cstdint>

#include "core/math/random.h"
#include "core/math/vec.h"

namespace exphoton {

constexpr std::uint32_t ReverseBits32(std::uint32_t v) {
  v = (v << 16) | (v >> 16);
  v = ((v & 0x00ff00ffu) << 8) | ((v & 0xff00ff00u) >> 8);
  v = ((v & 0x0f0f0f0fu) << 4) | ((v & 0xf0f0f0f0u) >> 4);
  v = ((v & 0x33333333u) << 2) | ((v & 0xccccccccu) >> 2);
  return ((v & 0x55555555u) << 1) | ((v & 0xaaaaaaaau) >> 1);
}

// Owen scrambling of a 32-bit binary fraction, tree chosen by `key`.
constexpr std::uint32_t OwenScramble(std::uint32_t v, std::uint32_t key) {
  v = ReverseBits32(v);
  v += key;
  v ^= v * 0x6c50b47cu;
  v ^= v * 0xb82f1e52u;
  v ^= v * 0xc7afe638u;
  v ^= v * 0x8d22f6e6u;
  return ReverseBits32(v);
}

// Second Sobol' dimension (the first is the bit-reversed index) as a 32-bit fraction.
constexpr std::uint32_t SobolSecond(std::uint32_t index) {
  std::uint32_t result = 0;
  for (std::uint32_t v = 1u << 31; index != 0; index >>= 1, v ^= v >> 1)
    if (index & 1) result ^= v;
  return result;
}

// Cut off, not rounded, so that no point leaves its binary stratum.
inline Real FractionToReal(std::uint32_t v) {
  if constexpr (sizeof(Real) == 4) v &= 0xffffff00u;
  return Real(v) * Real(1.0 / 4294967296.0);
}

// Point `index` of the scrambled van der Corput sequence and of the scrambled (0,2)-sequence.
inline Real ScrambledVanDerCorput(std::uint32_t index, std::uint32_t key) {
  return FractionToReal(OwenScramble(ReverseBits32(index), key));
}
inline Point2 ScrambledSobol2(std::uint32_t index, std::uint64_t key) {
  return {FractionToReal(OwenScramble(ReverseBits32(index), std::uint32_t(key))),
          FractionToReal(OwenScramble(SobolSecond(index), std::uint32_t(key >> 32)))};
}

inline constexpr std::uint32_t kPrimes[] = {2, 3, 5, 7, 11, 13, 17, 19, 23, 29, 31, 37};

// Radical inverse of a 64-bit index in `base`, every digit permuted by a permutation chosen by
// key and by the digits before it (nested, Owen); in [0, kOneMinusEpsilon]. Trailing zero digits
// are permuted too, down to the resolution of Real.
inline Real ScrambledRadicalInverse(std::uint32_t base, std::uint64_t index, std::uint64_t key) {
  const double inverseBase = 1.0 / base;
  double scale = inverseBase, value = 0;
  std::uint64_t prefix = key;
  for (int digitIndex = 0; scale > 1e-9 || index != 0; ++digitIndex, scale *= inverseBase) {
    const auto digit = static_cast<std::uint32_t>(index % base);
    index /= base;
    const std::uint32_t permuted =
        PermuteIndex(digit, base, static_cast<std::uint32_t>(MixBits(prefix)));
    value += permuted * scale;
    prefix = MixBits(prefix + 0x9e3779b97f4a7c15ull * (permuted + 1));
    if (scale < 1e-300) break;
  }
  return std::min(Real(value), kOneMinusEpsilon);
}

}  // namespace exphoton
