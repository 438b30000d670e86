// SPDX-License-Identifier: BSD-2-Clause
// TGA input (Truevision TGA, version 2.0 of 1991): grey, colour and colour-mapped pictures of 8 to
// 32 bits, plain or run-length encoded.
#pragma once

#include <string>
#include <string_view>

#include "core/imaging/image.h"

namespace exphoton {

// Returns whether the file is a TGA picture: by the end of its name, or by the signature at its
// end. Other files have nothing that identifies them.
bool IsTga(const std::string& path, std::string_view bytes);

// `path` is for messages only. Bytes are decoded from sRGB to linear. The channels are R, G, B, and
// A if the picture has alpha. Throws ImageError.
Image ParseTga(const std::string& path, std::string_view bytes);

}  // namespace exphoton
