// SPDX-License-Identifier: BSD-2-Clause
// SIMD targets are the instruction sets that kernels are compiled for. Google Highway compiles a
// kernel file once per target (hwy/foreach_target.h), and the program chooses a target at run time.
// This header must precede every header of Highway, because it selects the targets: on x86-64
// SSE4.2, AVX2 and AVX-512; on other machines only the baseline, which is NEON on 64-bit ARM.
//
// A kernel file defines the same names in exphoton::HWY_NAMESPACE for each target and ends with a
// list of them (EXPHOTON_SIMD_TARGETS). Never include headers between HWY_BEFORE_NAMESPACE and
// HWY_AFTER_NAMESPACE: the linker could use their inline functions, compiled for a target, in other
// files.
#pragma once

// Scalable vectors (SVE) cannot be members of a struct. The other x86 targets of Highway would add
// compile time only: without SSE4.2 it has no vectors at all.
#define HWY_DISABLED_TARGETS \
  (HWY_SSSE3 | HWY_AVX3_DL | HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128)
#if defined(EXPHOTON_STOCHASTIC)  // scalars, because each lane must round by itself
#define HWY_COMPILE_ONLY_EMU128
#elif defined(__x86_64__)
#define HWY_BASELINE_TARGETS HWY_SSE4
#else
// One target only, compiled without target attributes: on ARM, the compiler generates constructors
// without them and could not inline those of Highway's vectors.
#define HWY_COMPILE_ONLY_STATIC
#define TOOLCHAIN_MISS_SYS_AUXV_H
#endif
#define HWY_DISABLE_PCLMUL_AES  // no kernel needs these features
#define HWY_DISABLE_F16C
#define HWY_IS_DEBUG_BUILD 0  // assertions would need Highway's library; the headers suffice

#include <hwy/detect_targets.h>

#include <cstddef>
#include <stdexcept>

// Expands to pointers to the objects or functions `name` of all targets, the narrowest first. It is
// valid at the end of a kernel file, after hwy/highway.h, in the namespace exphoton.
#if defined(__x86_64__) && !defined(EXPHOTON_STOCHASTIC)
#define EXPHOTON_SIMD_TARGETS(name) \
  { &N_SSE4::name, &N_AVX2::name, &N_AVX3::name }
#else
#define EXPHOTON_SIMD_TARGETS(name) \
  { &HWY_STATIC_DISPATCH(name) }
#endif

// Precedes a loop that reads nothing that it has written. The compiler then skips its dependence
// checks.
#if defined(__clang__)
#define EXPHOTON_INDEPENDENT_ITERATIONS _Pragma("clang loop vectorize(assume_safety)")
#else
#define EXPHOTON_INDEPENDENT_ITERATIONS _Pragma("GCC ivdep")
#endif

namespace exphoton {

// Returns the number of targets in EXPHOTON_SIMD_TARGETS that this machine can run. A target counts
// only if the machine has every feature that the target is compiled for. All run-time choices of a
// target go by this function.
inline std::size_t UsableSimdTargets() {
  std::size_t usable = 1;
#if defined(__x86_64__) && !defined(EXPHOTON_STOCHASTIC)
  if (!__builtin_cpu_supports("sse4.2"))
    throw std::runtime_error("this machine lacks SSE4.2, which every kernel needs");
  // The features of HWY_TARGET_STR_AVX2. A virtual machine may hide some of them.
  if (!__builtin_cpu_supports("avx2") || !__builtin_cpu_supports("bmi") ||
      !__builtin_cpu_supports("bmi2") || !__builtin_cpu_supports("fma"))
    return usable;
  ++usable;
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") &&
      __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512bw"))
    ++usable;
#endif
  return usable;
}

}  // namespace exphoton
