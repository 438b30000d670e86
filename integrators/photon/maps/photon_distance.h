// SPDX-License-Identifier: BSD-2-Clause
// EncodeDistance stores a distance in eight bits as a fraction of a reference distance. The code is
// logarithmic with eight steps per octave, so its error is within 4.5 %. Fractions are clamped to
// [2^-32, 1]. This suffices to reproject the direction of a photon to nearby points.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "core/math/real.h"

namespace exphoton {

inline constexpr int kDistanceStepsPerOctave = 8;

// part: the distance over the reference distance, so that the code is independent of scale.
inline std::uint8_t EncodeDistance(Real part) {
  const Real least = std::ldexp(Real(1), -32);
  const Real octaves = -std::log2(std::clamp(part, least, Real(1)));
  return std::uint8_t(std::min(255L, std::lround(octaves * kDistanceStepsPerOctave)));
}
inline Real DecodeDistance(std::uint8_t code) {
  return std::exp2(-Real(code) / kDistanceStepsPerOctave);
}

}  // namespace exphoton
