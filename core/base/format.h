// SPDX-License-Identifier: BSD-2-Clause
// Format is std::snprintf into a std::string. Texts longer than 511 characters are cut. Counted
// puts a number before a noun.
#pragma once

#include <cstdint>
#include <cstdio>
#include <string>

namespace exphoton {

template <class... Args>
std::string Format(const char* format, Args... args) {
  char text[512];
  std::snprintf(text, sizeof text, format, args...);
  return text;
}

// Returns "1 sample" or "4 samples" for the noun "sample".
inline std::string Counted(std::int64_t count, const std::string& noun) {
  return std::to_string(count) + ' ' + noun + (count == 1 ? "" : "s");
}

}  // namespace exphoton
