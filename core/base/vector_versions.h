// SPDX-License-Identifier: BSD-2-Clause
// For loops that compilers turn into vectors by themselves: one body, inlined into a function for
// any machine and into one for AVX2, of which the program chooses when it runs. Where operations
// are what vectors keep (no sums of Reals across lanes), both give the same bits.
#pragma once

#include <cstddef>

#if defined(__x86_64__)
#define EXPHOTON_FOR_AVX2 __attribute__((target("avx2")))
#else
#define EXPHOTON_FOR_AVX2
#endif

// Before a loop that reads nothing which it has written: compilers need not look whether it does.
#if defined(__clang__)
#define EXPHOTON_INDEPENDENT_ITERATIONS _Pragma("clang loop vectorize(assume_safety)")
#else
#define EXPHOTON_INDEPENDENT_ITERATIONS _Pragma("GCC ivdep")
#endif

namespace exphoton {

// How many of {for any machine, for AVX2} this machine can run.
inline std::size_t VectorVersions() {
#if defined(__x86_64__)
  return __builtin_cpu_supports("avx2") ? 2 : 1;
#else
  return 1;
#endif
}

}  // namespace exphoton
