// SPDX-License-Identifier: BSD-2-Clause
// SIMD targets are function attributes for loops that compilers vectorise by themselves. One loop
// body is inlined into a portable, an AVX2 and an AVX-512 function, and the program chooses one at
// run time. All give the same bits if the loop has no sum of Reals across iterations.
#pragma once

#include <cstddef>

#if defined(__x86_64__)
#define EXPHOTON_FOR_AVX2 __attribute__((target("avx2")))
#define EXPHOTON_FOR_AVX512 \
  __attribute__((target("avx512f,avx512bw,avx512dq,avx512vl,prefer-vector-width=512")))
#else
#define EXPHOTON_FOR_AVX2
#define EXPHOTON_FOR_AVX512
#endif

// Precedes a loop that reads nothing that it has written. The compiler then skips its dependence
// checks.
#if defined(__clang__)
#define EXPHOTON_INDEPENDENT_ITERATIONS _Pragma("clang loop vectorize(assume_safety)")
#else
#define EXPHOTON_INDEPENDENT_ITERATIONS _Pragma("GCC ivdep")
#endif

namespace exphoton {

// Returns the number of usable targets on this machine, in the order {portable, AVX2, AVX-512}. A
// target counts only if the machine has every feature that any file of that target is compiled for.
// All run-time choices of a target go by this function.
inline std::size_t UsableSimdTargets() {
#if defined(__x86_64__)
  if (!__builtin_cpu_supports("avx2") || !__builtin_cpu_supports("fma") ||
      !__builtin_cpu_supports("bmi") || !__builtin_cpu_supports("popcnt"))
    return 1;
  const bool has512 = __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
                      __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl");
  return has512 ? 3 : 2;
#else
  return 1;
#endif
}

}  // namespace exphoton
