// SPDX-License-Identifier: BSD-2-Clause
// PNG input and output: previews (sRGB, 8 bit, exposure in stops) and texture files.
#pragma once

#include <string>

#include "core/imaging/files/tone.h"
#include "core/imaging/image.h"

namespace exphoton {

// Writes the channels R, G, B (and A if present). R, G, B are divided by A, if they were multiplied
// by it, and then tone-mapped and sRGB-encoded. The write is atomic, as in WriteExr. Throws
// Error(File).
void WritePng(const std::string& path, const Image& image, const ToneMapping& tone = {});
// Returns the bytes that WritePng writes.
std::string EncodePng(const Image& image, const ToneMapping& tone = {});
Image ReadPng(const std::string& path);  // throws ImageError

}  // namespace exphoton
