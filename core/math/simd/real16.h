// SPDX-License-Identifier: BSD-2-Clause
// Real16: sixteen numbers at a time, for loops that compilers do not turn into vectors by
// themselves. One algorithm is written in terms of it (a file .inl) and compiled for each width of
// vectors: its file for a width includes real16_begin_avx2.inl (or avx512; nothing for any
// machine), in its anonymous namespace real16_avx2.inl and the algorithm, and at last
// vectors_end.inl. All operations are lane by lane and rounded as single ones, so that every width
// gives the same bits. Masks have one bit a lane, the lowest for the first.
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
