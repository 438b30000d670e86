// SPDX-License-Identifier: BSD-2-Clause
// JPEG input by libjpeg-turbo: baseline and progressive pictures, grey or colour, of 8 bits.
#pragma once

#include <string>
#include <string_view>

#include "core/imaging/image.h"

namespace exphoton {

bool IsJpeg(std::string_view bytes);  // by the first bytes

// `path` is for messages only. Bytes are decoded from sRGB to linear. The channels are R, G, B.
// Throws ImageError, also if the file is truncated or damaged.
Image ParseJpeg(const std::string& path, std::string_view bytes);

}  // namespace exphoton
