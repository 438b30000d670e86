// SPDX-License-Identifier: BSD-2-Clause
// This file includes the headers of real16_avx2.inl and enables AVX2 until vectors_end.inl. Do not
// include headers in between: the linker could use their inline functions, compiled for AVX2, in
// other files.
#include <immintrin.h>

#include <algorithm>
#include <array>
#include <bit>
#include <limits>

#if defined(__clang__)
#pragma clang attribute push(__attribute__((target("avx2,bmi,popcnt"))), apply_to = function)
#else
#pragma GCC push_options
#pragma GCC target("avx2,bmi,popcnt")
#endif
