// SPDX-License-Identifier: BSD-2-Clause
// What an OpenEXR file says of its own sizes, checked against the file before the library believes
// it: a few damaged bytes would make it allocate gigabytes.
#pragma once

#include <cstdint>
#include <string>

namespace exphoton {

// Throws ImageError if it is no OpenEXR file or an attribute of a header is longer than the file or
// has not the size of its type. Other damage is left to the library.
void CheckExrHeaders(const std::string& path);

// Throws ImageError where a file of this length cannot hold so many bytes of pixels, however well
// they are compressed.
void CheckExrPixels(const std::string& path, double pixelBytes);

}  // namespace exphoton
