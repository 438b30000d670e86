// SPDX-License-Identifier: BSD-2-Clause
// The sRGB transfer functions of IEC 61966-2-1, between encoded values and linear light in [0, 1].
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

namespace exphoton {

inline double DecodeSrgb(double v) {
  return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
}
inline double EncodeSrgb(double v) {
  return v <= 0.0031308 ? v * 12.92 : 1.055 * std::pow(v, 1 / 2.4) - 0.055;
}

// Returns the linear values of the 256 encoded bytes.
inline std::array<float, 256> SrgbTable() {
  std::array<float, 256> linear;
  for (std::size_t i = 0; i < 256; ++i) linear[i] = float(DecodeSrgb(double(i) / 255));
  return linear;
}

}  // namespace exphoton
