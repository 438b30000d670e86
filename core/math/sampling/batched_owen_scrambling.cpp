// SPDX-License-Identifier: BSD-2-Clause
// BatchedOwenScrambling is one loop that is compiled for each SIMD target.
#include "core/math/sampling/batched_owen_scrambling.h"

#include "core/base/simd_targets.h"
#include "core/math/sampling/low_discrepancy.h"

namespace exphoton {
namespace {

[[gnu::always_inline]] inline void Run(const std::uint32_t* reversed, std::size_t count,
                                       std::uint32_t key, Real* fractions) {
  for (std::size_t i = 0; i < count; ++i) fractions[i] = ScrambledVanDerCorput(reversed[i], key);
}

void RunPortable(const std::uint32_t* reversed, std::size_t count, std::uint32_t key,
                 Real* fractions) {
  Run(reversed, count, key, fractions);
}

EXPHOTON_FOR_AVX2 void RunAvx2(const std::uint32_t* reversed, std::size_t count, std::uint32_t key,
                               Real* fractions) {
  Run(reversed, count, key, fractions);
}

EXPHOTON_FOR_AVX512 void RunAvx512(const std::uint32_t* reversed, std::size_t count,
                                   std::uint32_t key, Real* fractions) {
  Run(reversed, count, key, fractions);
}

}  // namespace

std::span<const Scrambler> AvailableScramblers() {
  static constexpr Scrambler kAll[] = {RunPortable, RunAvx2, RunAvx512};
  return {kAll, UsableSimdTargets()};
}

void BatchedOwenScrambling(const std::uint32_t* reversed, std::size_t count, std::uint32_t key,
                           Real* fractions) {
  static const Scrambler fastest = AvailableScramblers().back();
  fastest(reversed, count, key, fractions);
}

}  // namespace exphoton
