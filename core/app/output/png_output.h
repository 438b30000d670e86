// SPDX-License-Identifier: BSD-2-Clause
// PngOutput holds the options of commands that write PNG files, and writes the files.
#pragma once

#include <optional>
#include <string>

#include "core/imaging/files/tone.h"

namespace exphoton {
class Log;
}

namespace exphoton::cli {

class OptionParser;

struct PngOptions {
  std::string exposure, curve;  // as given; "": not given

  bool IsGiven() const { return !exposure.empty() || !curve.empty(); }
};

// Declares --exposure and --tone-curve.
void AddPngOptions(OptionParser& app, PngOptions* options);

// Throws Error(CommandLine) for a value of --exposure that is no number and not "auto".
void CheckPngOptions(const PngOptions& options);

// Writes a PNG. Prints the exposure that "auto" chose. Hints at another exposure if more than a
// fifth of the pixels are clipped or black.
void WritePngPicture(const std::string& path, const Image& image, const PngOptions& options,
                     Log& log);

// Returns whether the name ends in .png or .exr, in letters of any case.
bool IsPngName(const std::string& path);
bool IsExrName(const std::string& path);

// Returns a name that ends in .exr: "room.exr" for "room.tga" and for "room". Endings that are not
// those of a picture remain: "room.v2.exr" for "room.v2".
std::string ExrName(const std::string& path);

}  // namespace exphoton::cli
