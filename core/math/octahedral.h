// SPDX-License-Identifier: BSD-2-Clause
// Octahedral codes store unit vectors in 32 bits. The sphere is projected onto an octahedron, which
// is unfolded into a square of 2 x 16 bits. The error is below 7e-5 radians, and the axes are
// exact. A code with an 8-bit payload has an error below 1.2e-3 radians. Source: Cigolle et al.
// 2014, "A Survey of Efficient Representations for Independent Unit Vectors".
#pragma once

#include <cmath>
#include <cstdint>

#include "core/math/vec.h"

namespace exphoton {

inline constexpr Real kOctahedralOne = 32767;

// Returns the place of v, unit or nearly unit, in the square from (-1, -1) to (1, 1).
inline Point2 OctahedralPlace(const Vector3& v) {
  const Real scale = 1 / (std::abs(v.x) + std::abs(v.y) + std::abs(v.z));
  Real a = v.x * scale, b = v.y * scale;
  if (v.z < 0) {
    const Real folded = std::copysign(1 - std::abs(b), a);
    b = std::copysign(1 - std::abs(a), b);
    a = folded;
  }
  return {a, b};
}

inline std::uint32_t EncodeOctahedral(const Vector3& v) {
  const auto half = [](Real x) {
    return std::uint32_t(std::uint16_t(std::int16_t(std::lround(x * kOctahedralOne))));
  };
  const Point2 place = OctahedralPlace(v);
  return half(place.x) | half(place.y) << 16;
}

// Encodes v with an 8-bit payload. Each half of the code ends in four bits of the payload. The code
// is the closest to v with this ending and is decoded like any other.
inline std::uint32_t EncodeOctahedral(const Vector3& v, std::uint8_t payload) {
  constexpr int kStep = 16, kMaxCode = int(kOctahedralOne);
  const auto half = [](Real x, int end) {
    int code = kStep * int(std::lround((x * kOctahedralOne - Real(end)) / kStep)) + end;
    if (code > kMaxCode) code -= kStep;
    if (code < -kMaxCode) code += kStep;
    return std::uint32_t(std::uint16_t(std::int16_t(code)));
  };
  const Point2 place = OctahedralPlace(v);
  return half(place.x, payload % kStep) | half(place.y, payload / kStep) << 16;
}
inline std::uint8_t OctahedralPayload(std::uint32_t bits) {
  return std::uint8_t((bits & 15) | (bits >> 12 & 0xf0));
}

// Decodes to a vector that is not normalised, for uses that need only a sign. Components are whole
// numbers, so every step is exact.
inline Vector3 DecodeOctahedralUnnormalized(std::uint32_t bits) {
  const Real a = Real(std::int16_t(bits & 0xffff)), b = Real(std::int16_t(bits >> 16));
  const Real z = kOctahedralOne - std::abs(a) - std::abs(b);
  const Real fold = z < 0 ? -z : Real(0);
  return {a - std::copysign(fold, a), b - std::copysign(fold, b), z};
}

inline Vector3 DecodeOctahedral(std::uint32_t bits) {
  return Normalize(DecodeOctahedralUnnormalized(bits));
}

}  // namespace exphoton
