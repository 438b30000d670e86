// SPDX-License-Identifier: BSD-2-Clause
// Progressive passes shrink the disks of all density estimates from pass to pass. Their mean then
// tends to the true picture: its variance and its squared bias both tend to 0. Source: Knaus and
// Zwicker 2011, "Progressive Photon Mapping: A Probabilistic Approach", eq. 20.
#pragma once

#include <cstdint>

#include "core/math/real.h"

namespace exphoton {

// The variance of the mean falls as i^-alpha and its squared bias as i^(2 alpha - 2). With this
// value the sum of both falls fastest, as i^(-2/3).
constexpr double kProgressiveAlpha = 2. / 3;

// Returns the area of the disks of a pass, relative to the first pass: the product of
// (j + alpha) / (j + 1) over all j from 1 to `pass`. Passes are numbered from 0, and alpha lies
// above 0 and is at most 1.
double DiskAreaOfPass(int pass, double alpha);

// Returns the point of the exposure, in [0,1), at which all paths of a pass see a moving scene. The
// passes are well distributed over the exposure.
Real TimeOfPass(int pass, std::uint64_t seed);

}  // namespace exphoton
