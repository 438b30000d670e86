// SPDX-License-Identifier: BSD-2-Clause
// Cryptomatte stores which objects a pixel shows, and to which share, so that programs can make
// masks of objects. These functions follow the Cryptomatte specification 1.2 (Psyop 2015 to 2018).
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>

#include "core/imaging/image.h"

namespace exphoton {

// MurmurHash3 for 32 bits, by Austin Appleby (public domain), with the seed 0.
std::uint32_t MurmurHash3(std::string_view text);

// Returns the hash with bits changed so that they are a finite float that is not denormal.
std::uint32_t CryptomatteHash(std::string_view name);

// Replaces the numbers of a layer, such as "CryptoObject", by the ids of their names, and adds the
// attributes of the layer. Without the channels of this layer, does nothing.
void FinishCryptomatte(const std::string& layer,
                       const std::function<std::string(std::uint32_t number)>& nameOf,
                       std::uint32_t count, Image* image);

}  // namespace exphoton
