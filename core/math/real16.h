// SPDX-License-Identifier: BSD-2-Clause
// Real16: sixteen numbers at a time, for loops that compilers do not turn into vectors by
// themselves. One algorithm is written in terms of it (a file .inl) and compiled for each width of
// vectors: its file for a width opens its anonymous namespace, with the compiler told of the
// instructions, and includes real16_portable.inl, real16_avx2.inl or real16_avx512.inl and then the
// algorithm. All operations are lane by lane and rounded as single ones, so that every width gives
// the same bits. Masks have one bit a lane, the lowest for the first.
#pragma once

#include <cstdint>

#include "core/math/vec.h"

// Whether there are versions for AVX2 and AVX-512: to be called only where the machine has them.
#if defined(__x86_64__) && !defined(EXPHOTON_DOUBLE)
#define EXPHOTON_WIDE_VECTORS 1
#endif

namespace exphoton {

inline constexpr std::uint32_t kReal16Lanes = 16;

}  // namespace exphoton
