// SPDX-License-Identifier: BSD-2-Clause
// BatchedOwenScrambling: Owen scrambling of many points of a sequence under one key, with the
// widest vectors that the machine has; the same bits with any.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "core/math/real.h"

namespace exphoton {

// fractions[i] = ScrambledVanDerCorput(reversed[i], key), in [0, 1).
void BatchedOwenScrambling(const std::uint32_t* reversed, std::size_t count, std::uint32_t key,
                           Real* fractions);

// One for each width of vectors that this machine can run, the widest last: for tests.
using Scrambler = void (*)(const std::uint32_t* reversed, std::size_t count, std::uint32_t key,
                           Real* fractions);
std::span<const Scrambler> AvailableScramblers();

}  // namespace exphoton
