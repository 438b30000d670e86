// SPDX-License-Identifier: BSD-2-Clause
// Real16 holds sixteen Reals, for loops that compilers do not vectorise by themselves. An algorithm
// in a .inl file is compiled for each SIMD target. The file of a target includes
// real16_begin_avx2.inl (or avx512; none for portable), then real16_avx2.inl and the algorithm in
// its anonymous namespace, then vectors_end.inl. Lanes are rounded like scalars, so all targets
// give the same bits.
#pragma once

#include <cstdint>

#include "core/math/vec.h"

// The macro is defined if AVX2 and AVX-512 versions exist. Call them only on machines with these
// instructions.
#if defined(__x86_64__) && !defined(EXPHOTON_DOUBLE)
#define EXPHOTON_WIDE_VECTORS 1
#endif

namespace exphoton {

// Masks have one bit per lane, the lowest bit for the first lane.
inline constexpr std::uint32_t kReal16Lanes = 16;

}  // namespace exphoton
