// SPDX-License-Identifier: BSD-2-Clause
// MixBits and MixWord compute hashes of 64 bits. They distinguish inputs and are not cryptographic.
#pragma once

#include <cstdint>

namespace exphoton {

// The finaliser of SplitMix64 (Steele, Lea and Flood 2014). It is a bijection.
constexpr std::uint64_t MixBits(std::uint64_t v) {
  v ^= v >> 30;
  v *= 0xbf58476d1ce4e5b9ull;
  v ^= v >> 27;
  v *= 0x94d049bb133111ebull;
  v ^= v >> 31;
  return v;
}

// Combines the hash of some words with the next word. It is a bijection of the hash and of the
// word.
constexpr std::uint64_t MixWord(std::uint64_t hash, std::uint64_t word) {
  return MixBits((hash ^ word) + 0x9e3779b97f4a7c15ull);
}

}  // namespace exphoton
