// SPDX-License-Identifier: BSD-2-Clause
// Distances in eight bits, as parts of another one: eight steps to an octave, so within 4.5 %, from
// that one to a 2^32th of it; what is nearer or farther is taken to the end. Good enough for how
// directions change from a photon to a point close to it.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "core/math/real.h"

namespace exphoton {

inline constexpr int kDistanceStepsPerOctave = 8;

// part: of the distance that others are measured by; the code is the same at every scale.
inline std::uint8_t EncodeDistance(Real part) {
  const Real least = std::ldexp(Real(1), -32);
  const Real octaves = -std::log2(std::clamp(part, least, Real(1)));
  return std::uint8_t(std::min(255L, std::lround(octaves * kDistanceStepsPerOctave)));
}
inline Real DecodeDistance(std::uint8_t code) {
  return std::exp2(-Real(code) / kDistanceStepsPerOctave);
}

}  // namespace exphoton
