// SPDX-License-Identifier: BSD-2-Clause
// PackedRadiance stores the radiance of a radiance photon and two properties of its surface in the
// memory of the radiance alone. Radiance is never negative, so the sign bits of the channels are
// free. The sign of red holds whether the surface is coated; green and blue hold the glossy share
// in four steps.
#pragma once

#include <array>
#include <cmath>

#include "core/math/spectrum.h"

namespace exphoton {

class PackedRadiance {
 public:
  // A glossy share is rounded up to one of these steps.
  static constexpr std::array<Real, 4> kShares{Real(1) / 16, Real(1) / 4, Real(1) / 2, 1};

  PackedRadiance() = default;
  PackedRadiance(const Spectrum& radiance, Real glossyShare, bool isCoated) {
    unsigned step = 0;
    while (step + 1 < kShares.size() && kShares[step] < glossyShare) ++step;
    packed_ = {std::copysign(radiance.r, isCoated ? Real(-1) : Real(1)),
               std::copysign(radiance.g, (step & 1u) != 0 ? Real(-1) : Real(1)),
               std::copysign(radiance.b, (step & 2u) != 0 ? Real(-1) : Real(1))};
  }

  Spectrum Radiance() const {
    return {std::abs(packed_.r), std::abs(packed_.g), std::abs(packed_.b)};
  }
  Real GlossyShare() const {
    return kShares[std::size_t(std::signbit(packed_.g)) + 2 * std::size_t(std::signbit(packed_.b))];
  }
  bool IsCoated() const { return std::signbit(packed_.r); }

 private:
  Spectrum packed_;
};

}  // namespace exphoton
