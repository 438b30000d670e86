// SPDX-License-Identifier: BSD-2-Clause
// For loops that compilers turn into vectors by themselves: one body, inlined into a function for
// any machine, one for AVX2 and one for AVX-512, of which the program chooses when it runs. Where
// operations are what vectors keep (no sums of Reals across lanes), all give the same bits.
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

// Before a loop that reads nothing which it has written: compilers need not look whether it does.
#if defined(__clang__)
#define EXPHOTON_INDEPENDENT_ITERATIONS _Pragma("clang loop vectorize(assume_safety)")
#else
#define EXPHOTON_INDEPENDENT_ITERATIONS _Pragma("GCC ivdep")
#endif

namespace exphoton {

// How many of {for any machine, for AVX2, for AVX-512} this machine can run.
inline std::size_t SimdTargets() {
#if defined(__x86_64__)
  if (!__builtin_cpu_supports("avx2")) return 1;
  const bool has512 = __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
                      __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl");
  return has512 ? 3 : 2;
#else
  return 1;
#endif
}

}  // namespace exphoton
