// SPDX-License-Identifier: BSD-2-Clause
// The searches for x86-64 machines with AVX-512: a vector of sixteen is one register. Lanes are
// compressed in registers and stored whole: compressing stores are slow on some machines.
#include "core/spatial/nearest_search.h"

#if defined(EXPHOTON_WIDE_VECTORS)
#include <immintrin.h>

#include <algorithm>
#include <bit>
#include <limits>

#if !defined(__clang__)
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"  // GCC bug 105593: in its own intrinsics
#endif

// From here on, and not for the headers above: an inline function of theirs that was compiled for
// AVX-512 could replace the one that other files use.
#if defined(__clang__)
#pragma clang attribute push(__attribute__((target("avx512f,avx2,bmi,popcnt"))), \
                             apply_to = function)
#else
#pragma GCC push_options
#pragma GCC target("avx512f,avx2,bmi,popcnt")
#endif

namespace exphoton {
namespace {

#include "core/math/real16_avx512.inl"
#include "core/spatial/nearest_search.inl"

}  // namespace

const NearestSearch kAvx512NearestSearch{"AVX-512", FindBlockNear, Nearest, Closest};

}  // namespace exphoton

#if defined(__clang__)
#pragma clang attribute pop
#else
#pragma GCC pop_options
#endif
#endif
