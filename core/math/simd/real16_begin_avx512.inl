// SPDX-License-Identifier: BSD-2-Clause
// This file includes the headers of real16_avx512.inl and enables AVX-512 until vectors_end.inl. Do
// not include headers in between: the linker could use their inline functions, compiled for
// AVX-512, in other files.
#include <immintrin.h>

#include <algorithm>
#include <array>
#include <bit>
#include <limits>

#if !defined(__clang__)
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"  // GCC bug 105593, in its intrinsics
#endif

#if defined(__clang__)
#pragma clang attribute push(__attribute__((target("avx512f,avx2,bmi,popcnt"))), \
                             apply_to = function)
#else
#pragma GCC push_options
#pragma GCC target("avx512f,avx2,bmi,popcnt")
#endif
