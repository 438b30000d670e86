// SPDX-License-Identifier: BSD-2-Clause
// PNG in and out: previews (sRGB, 8 bit, exposure in stops) and texture files.
#pragma once

#include <string>

#include "core/imaging/image.h"

namespace exphoton {

// Channels R,G,B (and A if present) tone-mapped by 2^exposure, clamped, sRGB-encoded. Atomic as
// WriteExr. Throws Error(File).
void WritePng(const std::string& path, const Image& image, float exposure = 0);
// The bytes of that file.
std::string EncodePng(const Image& image, float exposure = 0);
Image ReadPng(const std::string& path);  // throws ImageError

}  // namespace exphoton
