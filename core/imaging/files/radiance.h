// SPDX-License-Identifier: BSD-2-Clause
// Radiance HDR input (.hdr, .pic): colours with a common exponent, plain or run-length encoded.
// Source: Ward, "Real Pixels" (Graphics Gems II, 1991), and the file format of Radiance.
#pragma once

#include <string>
#include <string_view>

#include "core/imaging/image.h"

namespace exphoton {

bool IsRadiance(std::string_view bytes);  // by the first bytes

// `path` is for messages only. The channels are R, G, B, linear, and divided by the product of the
// header's EXPOSURE values, as the format says. Throws ImageError, also if the file is truncated.
Image ParseRadiance(const std::string& path, std::string_view bytes);

}  // namespace exphoton
