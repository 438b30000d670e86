// SPDX-License-Identifier: BSD-2-Clause
#include "core/render/passes/progressive.h"

#include <cmath>

#include "core/math/sampling/low_discrepancy.h"
#include "core/math/sampling/random.h"

namespace exphoton {

// The product is Gamma(pass + 1 + alpha) / (Gamma(1 + alpha) Gamma(pass + 2)).
double DiskAreaOfPass(int pass, double alpha) {
  if (pass == 0) return 1;
  return std::exp(std::lgamma(pass + 1 + alpha) - std::lgamma(1 + alpha) - std::lgamma(pass + 2));
}

Real TimeOfPass(int pass, std::uint64_t seed) {
  constexpr std::uint64_t kTimeKey = 0x70726f67ull;
  return ScrambledVanDerCorput(std::uint32_t(pass), std::uint32_t(HashKey({seed, kTimeKey})));
}

}  // namespace exphoton
