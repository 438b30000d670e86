// SPDX-License-Identifier: BSD-2-Clause
// BatchedOwenScrambling applies Owen scrambling with one key to many points of a sequence. It uses
// the widest SIMD target of the machine; all targets give the same bits.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "core/math/real.h"

namespace exphoton {

// fractions[i] = ScrambledVanDerCorput(reversed[i], key), in [0, 1).
void BatchedOwenScrambling(const std::uint32_t* reversed, std::size_t count, std::uint32_t key,
                           Real* fractions);

// AvailableScramblers returns one function per SIMD target that this machine can run, the widest
// last. Tests compare them.
using Scrambler = void (*)(const std::uint32_t* reversed, std::size_t count, std::uint32_t key,
                           Real* fractions);
std::span<const Scrambler> AvailableScramblers();

}  // namespace exphoton
