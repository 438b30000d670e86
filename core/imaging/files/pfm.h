// SPDX-License-Identifier: BSD-2-Clause
// PFM input (portable float map): linear colours ("PF") or grey values ("Pf") in single precision,
// of either byte order, with the lowest row first.
#pragma once

#include <string>
#include <string_view>

#include "core/imaging/image.h"

namespace exphoton {

bool IsPfm(std::string_view bytes);  // by the first bytes

// `path` is for messages only. The channels are R, G, B. The size of the scale in the header
// multiplies all values. Throws ImageError.
Image ParsePfm(const std::string& path, std::string_view bytes);

}  // namespace exphoton
