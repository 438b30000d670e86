// SPDX-License-Identifier: BSD-2-Clause
// OpenEXR in and out: scanline RGBA and layers, half or float, ZIP.
#pragma once

#include <string>

#include "core/imaging/image.h"

namespace exphoton {

struct ExrWriteReport {
  long long clampedToHalf = 0;  // values beyond +-65504 written as +-65504
};

// Writes to a temporary file beside `path`, then renames it there: an error leaves an older file
// untouched and no temporary behind. Throws Error(File).
ExrWriteReport WriteExr(const std::string& path, const Image& image, bool asHalf);
Image ReadExr(const std::string& path);  // throws ImageError

// The attribute "software" of a file's first header; "" where it has none, or is no EXR file.
std::string ExrSoftware(const std::string& path);

// OpenEXR makes its pool of threads when it first has work for it; were there no memory for that,
// it would wait for ever for the work that it could not hand over. To be called before it has any.
void MakeTheLibrarysThreadPool();

}  // namespace exphoton
