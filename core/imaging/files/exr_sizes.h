// SPDX-License-Identifier: BSD-2-Clause
// Checks the sizes that an OpenEXR file states against the file's length before the library uses
// them. Otherwise, a few damaged bytes could make the library allocate gigabytes.
#pragma once

#include <cstdint>
#include <string>

namespace exphoton {

// Throws ImageError if the file is not an OpenEXR file, or if an attribute is longer than the file
// or has the wrong size for its type. The library detects other damage.
void CheckExrHeaders(const std::string& path);

// Throws ImageError if a file of this length cannot hold pixelBytes bytes of pixels under any
// compression.
void CheckExrPixels(const std::string& path, double pixelBytes);

}  // namespace exphoton
