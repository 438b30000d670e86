// SPDX-License-Identifier: BSD-2-Clause
// One loop, compiled for each width of vectors.
#include "core/math/scramble_run.h"

#include "core/math/low_discrepancy.h"

#if defined(__x86_64__)
#define EXPHOTON_WIDE_SCRAMBLING 1
#endif

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

#if defined(EXPHOTON_WIDE_SCRAMBLING)
__attribute__((target("avx2"))) void RunAvx2(const std::uint32_t* reversed, std::size_t count,
                                             std::uint32_t key, Real* fractions) {
  Run(reversed, count, key, fractions);
}
#endif

}  // namespace

std::span<const Scrambler> AvailableScramblers() {
  static constexpr Scrambler kAll[] = {
    RunPortable,
#if defined(EXPHOTON_WIDE_SCRAMBLING)
    RunAvx2,
#endif
  };
  std::size_t count = 1;
#if defined(EXPHOTON_WIDE_SCRAMBLING)
  if (__builtin_cpu_supports("avx2")) ++count;
#endif
  return {kAll, count};
}

void ScrambleRun(const std::uint32_t* reversed, std::size_t count, std::uint32_t key,
                 Real* fractions) {
  static const Scrambler fastest = AvailableScramblers().back();
  fastest(reversed, count, key, fractions);
}

}  // namespace exphoton
