// SPDX-License-Identifier: BSD-2-Clause
// EncodePhotonTime stores the time of a photon in eight bits, as a part of the exposure. Photons of
// some maps keep it instead of their distance (PhotonBuffer::times).
#pragma once

#include <algorithm>
#include <cstdint>

#include "core/math/real.h"

namespace exphoton {

// part: in [0,1] of the exposure.
inline std::uint8_t EncodePhotonTime(Real part) {
  return std::uint8_t(std::clamp(int(part * 256), 0, 255));
}
inline Real DecodePhotonTime(std::uint8_t code) { return (Real(code) + Real(.5)) / 256; }

}  // namespace exphoton
