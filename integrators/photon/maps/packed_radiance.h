// SPDX-License-Identifier: BSD-2-Clause
// PackedRadiance: the radiance of a radiance photon together with two facts about its surface, in
// the room of the radiance alone. Radiance is never negative, so the signs of its three channels
// are free: one holds whether the surface is coated, two hold the glossy share in four steps.
#pragma once

#include <array>
#include <cmath>

#include "core/math/spectrum.h"

namespace exphoton {

class PackedRadiance {
 public:
  // The steps that a glossy share is rounded up to.
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
