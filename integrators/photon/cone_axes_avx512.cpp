// SPDX-License-Identifier: BSD-2-Clause
// The loops over cone axes for x86-64 machines with AVX-512.
#include "integrators/photon/cone_axes_wide.h"

#if defined(EXPHOTON_WIDE_VECTORS)
#include <immintrin.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
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
#include "integrators/photon/cone_axes.inl"

}  // namespace

const ConeLoops kConeLoopsAvx512 = kLoops;

}  // namespace exphoton

#if defined(__clang__)
#pragma clang attribute pop
#else
#pragma GCC pop_options
#endif
#endif
