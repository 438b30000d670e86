// SPDX-License-Identifier: BSD-2-Clause
// What real16_avx512.inl needs, and from here on AVX-512: not for headers, an inline function of
// which could then replace the one that other files use. Until vectors_end.inl.
#include <immintrin.h>

#include <algorithm>
#include <array>
#include <bit>
#include <limits>

#if !defined(__clang__)
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"  // GCC bug 105593: in its own intrinsics
#endif

#if defined(__clang__)
#pragma clang attribute push(__attribute__((target("avx512f,avx2,bmi,popcnt"))), \
                             apply_to = function)
#else
#pragma GCC push_options
#pragma GCC target("avx512f,avx2,bmi,popcnt")
#endif
