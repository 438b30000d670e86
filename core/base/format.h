// SPDX-License-Identifier: BSD-2-Clause
// Format is std::snprintf into a std::string. Texts longer than 511 characters are cut.
#pragma once

#include <cstdio>
#include <string>

namespace exphoton {

template <class... Args>
std::string Format(const char* format, Args... args) {
  char text[512];
  std::snprintf(text, sizeof text, format, args...);
  return text;
}

}  // namespace exphoton
