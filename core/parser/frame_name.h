// SPDX-License-Identifier: BSD-2-Clause
// FrameName puts the number of a frame of an animation into the name of a file. "%d" stands for
// the number, "%04d" for the number with leading zeros (here four digits), as in printf.
#pragma once

#include <string>

namespace exphoton {

// Returns whether the name has a place for the number.
bool HasFrameNumber(const std::string& name);

// Returns the name with the number in all such places.
std::string FrameName(const std::string& name, int frame);

// Returns the name without these places: "room.exr" for "room%03d.exr".
std::string NameWithoutNumber(const std::string& name);

// Returns the format with which printf makes the names.
std::string FrameFormat(const std::string& name);

}  // namespace exphoton
