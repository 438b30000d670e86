// SPDX-License-Identifier: BSD-2-Clause
// The (0,2)-sequence of the first two Sobol' dimensions has 32-bit indices. A key randomises it by
// Owen scrambling with a hash (Laine and Karras 2011; Burley 2020, "Practical Hash-based Owen
// Scrambling").
#pragma once

#include <cstdint>

#include "core/math/sampling/random.h"
#include "core/math/vec.h"

namespace exphoton {

constexpr std::uint32_t ReverseBits32(std::uint32_t v) {
  v = __builtin_bswap32(v);
  v = ((v & 0x0f0f0f0fu) << 4) | ((v & 0xf0f0f0f0u) >> 4);
  v = ((v & 0x33333333u) << 2) | ((v & 0xccccccccu) >> 2);
  return ((v & 0x55555555u) << 1) | ((v & 0xaaaaaaaau) >> 1);
}

// OwenScramble scrambles a 32-bit binary fraction; `key` chooses the scrambling tree.
// OwenScrambleReversed takes and returns the bits in reverse order, which saves two bit reversals.
constexpr std::uint32_t OwenScrambleReversed(std::uint32_t v, std::uint32_t key) {
  v += key;
  v ^= v * 0x6c50b47cu;
  v ^= v * 0xb82f1e52u;
  v ^= v * 0xc7afe638u;
  v ^= v * 0x8d22f6e6u;
  return v;
}
constexpr std::uint32_t OwenScramble(std::uint32_t v, std::uint32_t key) {
  return ReverseBits32(OwenScrambleReversed(ReverseBits32(v), key));
}

// Returns the second Sobol' dimension as a 32-bit fraction with its bits in reverse order. (The
// first dimension is the bit-reversed index.) Its matrix is Pascal's triangle modulo 2, and C(j, i)
// is odd if the bits of i are among the bits of j (Lucas). Bit i is therefore the sum modulo 2 of
// all bits j whose number contains the bits of i.
constexpr std::uint32_t SobolSecondReversed(std::uint32_t index) {
  index ^= (index >> 16) & 0x0000ffffu;
  index ^= (index >> 8) & 0x00ff00ffu;
  index ^= (index >> 4) & 0x0f0f0f0fu;
  index ^= (index >> 2) & 0x33333333u;
  index ^= (index >> 1) & 0x55555555u;
  return index;
}
constexpr std::uint32_t SobolSecond(std::uint32_t index) {
  return ReverseBits32(SobolSecondReversed(index));
}

// Truncates instead of rounding, so that no point leaves its binary stratum.
inline Real FractionToReal(std::uint32_t v) {
  if constexpr (sizeof(Real) == 4) return Real(std::int32_t(v >> 8)) * Real(1.0 / 16777216.0);
  return Real(v) * Real(1.0 / 4294967296.0);
}

// These return point `index` of the scrambled van der Corput sequence and of the scrambled
// (0,2)-sequence.
inline Real ScrambledVanDerCorput(std::uint32_t index, std::uint32_t key) {
  return FractionToReal(ReverseBits32(OwenScrambleReversed(index, key)));
}
inline Point2 ScrambledSobol2(std::uint32_t index, std::uint64_t key) {
  const std::uint32_t first = OwenScrambleReversed(index, std::uint32_t(key));
  const std::uint32_t second =
      OwenScrambleReversed(SobolSecondReversed(index), std::uint32_t(key >> 32));
  return {FractionToReal(ReverseBits32(first)), FractionToReal(ReverseBits32(second))};
}

}  // namespace exphoton
