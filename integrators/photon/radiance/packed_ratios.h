// SPDX-License-Identifier: BSD-2-Clause
// PackedRatios stores, in three bytes, the ratio of a signed estimate (signed_power.h) to the
// estimate itself, for each channel. The ratio lies in [-1,1], and its error is at most 1/254.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "core/math/spectrum.h"

namespace exphoton {

class PackedRatios {
 public:
  PackedRatios() = default;
  // A ratio to 0 counts as 0.
  PackedRatios(const Spectrum& part, const Spectrum& whole) {
    for (int c = 0; c < Spectrum::kChannels; ++c) {
      const Real ratio = std::clamp(SafeDivide(part[c], whole[c], Real(0)), Real(-1), Real(1));
      steps_[std::size_t(c)] = std::int8_t(std::lround(double(ratio * kSteps)));
    }
  }

  // Returns the part that belongs to this whole.
  Spectrum PartOf(const Spectrum& whole) const {
    return Spectrum{Real(steps_[0]), Real(steps_[1]), Real(steps_[2])} * whole / kSteps;
  }

 private:
  static constexpr Real kSteps = 127;
  std::array<std::int8_t, 3> steps_{};
};

}  // namespace exphoton
