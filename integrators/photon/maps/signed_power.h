// SPDX-License-Identifier: BSD-2-Clause
// SignedPower stores the power of a photon and the sign of its path in the memory of the power
// alone. The sign is 1 or -1 at random, and the same for all photons of a path. An estimate in
// which the power of each photon has its sign has the expected value 0, and its square has about
// the variance of the estimate itself (docs/decisions/0090-noise-of-one-set-of-photons.md). Power
// is never negative, so the sign bit of red is free.
#pragma once

#include <cmath>

#include "core/math/spectrum.h"

namespace exphoton {

class SignedPower {
 public:
  SignedPower() = default;
  SignedPower(const Spectrum& power, bool isNegative) : packed_(power) {
    packed_.r = std::copysign(power.r, isNegative ? Real(-1) : Real(1));
  }

  Spectrum Power() const { return PowerOf(packed_.r, packed_.g, packed_.b); }
  Real Sign() const { return SignOf(packed_.r); }
  // The numbers in memory, for structures of arrays and files.
  Spectrum& Packed() { return packed_; }
  const Spectrum& Packed() const { return packed_; }

  static Spectrum PowerOf(Real packedRed, Real g, Real b) { return {std::abs(packedRed), g, b}; }
  static Real SignOf(Real packedRed) { return std::signbit(packedRed) ? Real(-1) : Real(1); }

 private:
  Spectrum packed_;
};

}  // namespace exphoton
