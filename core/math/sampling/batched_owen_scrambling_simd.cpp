// SPDX-License-Identifier: BSD-2-Clause
// BatchedOwenScrambling is one loop that the compiler vectorises for each SIMD target.
#include "core/math/sampling/batched_owen_scrambling.h"

#include "core/math/sampling/low_discrepancy.h"
#include "core/math/simd/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/math/sampling/batched_owen_scrambling_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace exphoton::HWY_NAMESPACE {

void Scramble(const std::uint32_t* reversed, std::size_t count, std::uint32_t key,
              Real* fractions) {
  for (std::size_t i = 0; i < count; ++i) fractions[i] = ScrambledVanDerCorput(reversed[i], key);
}

}  // namespace exphoton::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace exphoton {

std::span<const Scrambler> AvailableScramblers() {
  static constexpr Scrambler kAll[] = EXPHOTON_SIMD_TARGETS(Scramble);
  return {kAll, UsableSimdTargets()};
}

void BatchedOwenScrambling(const std::uint32_t* reversed, std::size_t count, std::uint32_t key,
                           Real* fractions) {
  static const Scrambler fastest = AvailableScramblers().back();
  fastest(reversed, count, key, fractions);
}

}  // namespace exphoton
#endif
