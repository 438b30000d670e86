// SPDX-License-Identifier: BSD-2-Clause
// PowerHeuristic computes the weights of multiple importance sampling (Veach 1997, section 9.2). It
// uses the ratio of the densities, which neither overflows nor loses small densities.
#pragma once

#include "core/math/real.h"

namespace exphoton {

// Returns the power heuristic (beta = 2) for a sample drawn nf times with density pf, while the
// other technique draws ng times with density pg: (nf pf)^2 / ((nf pf)^2 + (ng pg)^2). Returns 0 if
// pf is 0, 1 if pg is 0 or only pf is infinite, and 1/2 if both are infinite.
inline Real PowerHeuristic(int nf, Real pf, int ng, Real pg) {
  const Real f = Real(nf) * pf, g = Real(ng) * pg;
  if (!(f > 0)) return 0;
  if (!(g > 0)) return 1;
  if (std::isinf(f)) return std::isinf(g) ? Real(.5) : Real(1);
  if (std::isinf(g)) return 0;
  if (f >= g) {
    const Real ratio = g / f;
    return 1 / (1 + ratio * ratio);
  }
  const Real ratio = f / g, ratio2 = ratio * ratio;
  return ratio2 / (1 + ratio2);
}

}  // namespace exphoton
