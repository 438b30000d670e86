// SPDX-License-Identifier: BSD-2-Clause
// SquaredDifference compares two lights in double precision, because the square of faint or bright
// light leaves the range of float.
#pragma once

#include "core/math/spectrum.h"

namespace exphoton {

// Returns the sum over the channels.
inline double SquaredDifference(const Spectrum& a, const Spectrum& b) {
  double sum = 0;
  for (int c = 0; c < Spectrum::kChannels; ++c) {
    const double d = double(a[c]) - double(b[c]);
    sum += d * d;
  }
  return sum;
}

}  // namespace exphoton
