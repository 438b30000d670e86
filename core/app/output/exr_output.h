// SPDX-License-Identifier: BSD-2-Clause
// WriteExrPicture writes the EXR files of commands. It warns of values that 16 bits cannot hold.
#pragma once

#include <string>

namespace exphoton {
class Log;
struct ExrWriteReport;
struct Image;
}  // namespace exphoton

namespace exphoton::cli {

// Warns if values beyond +-65504 were written as +-65504.
void WarnOfClamping(const ExrWriteReport& report, Log& log);

// Calls WriteExr and WarnOfClamping. Colours that were read from a PNG or TGA file are first
// multiplied by alpha.
void WriteExrPicture(const std::string& path, const Image& image, bool asHalf, Log& log);

}  // namespace exphoton::cli
