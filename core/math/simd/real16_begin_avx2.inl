// SPDX-License-Identifier: BSD-2-Clause
// What real16_avx2.inl needs, and from here on AVX2: not for headers, an inline function of which
// could then replace the one that other files use. Until vectors_end.inl.
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
