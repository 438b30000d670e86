// SPDX-License-Identifier: BSD-2-Clause
// OpenEXR input and output: scanline RGBA and AOVs, half or float, ZIP compression.
#pragma once

#include <string>

#include "core/imaging/image.h"

namespace exphoton {

struct ExrWriteReport {
  long long clampedToHalf = 0;  // values beyond +-65504, written as +-65504
};

// Writes to a temporary file beside `path` and renames it to `path` at the end. An error leaves an
// older file untouched and no temporary file behind. Throws Error(File).
ExrWriteReport WriteExr(const std::string& path, const Image& image, bool asHalf);

// Throws ImageError. Sets exactChannels to the channels of 32 bits that 16 bits would damage. If
// the file also has channels of 16 bits, these are all channels of 32 bits. If all channels have 32
// bits, these are integers, Cryptomatte layers and the channels of exact AOVs.
Image ReadExr(const std::string& path);

// Returns the attribute "software" of the file's first header. Returns "" if it is missing or if
// the file is not an EXR file.
std::string ExrSoftware(const std::string& path);

// Creates OpenEXR's thread pool, which the library otherwise creates at its first use. If memory is
// exhausted at that time, the library waits forever for work that it could not start. Must be
// called before the library's first use of threads.
void CreateExrThreadPool();

}  // namespace exphoton
