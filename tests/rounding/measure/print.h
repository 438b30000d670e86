// SPDX-License-Identifier: BSD-2-Clause
// Print returns what std::printf would print, at most 399 characters.
#pragma once

#include <cstdio>
#include <string>

namespace exphoton::rounding {

template <class... Arguments>
std::string Print(const char* format, Arguments... arguments) {
  char text[400];
  std::snprintf(text, sizeof text, format, arguments...);
  return text;
}

}  // namespace exphoton::rounding
