// SPDX-License-Identifier: BSD-2-Clause
// CommandLineText quotes arguments for a POSIX shell.
#include "core/app/options/arguments.h"

namespace exphoton::cli {

std::string CommandLineText(const std::vector<std::string>& arguments) {
  constexpr const char* kHarmless =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+=./,:@%";
  std::string text;
  for (const std::string& argument : arguments) {
    if (!text.empty()) text += ' ';
    if (!argument.empty() && argument.find_first_not_of(kHarmless) == std::string::npos) {
      text += argument;
      continue;
    }
    text += '\'';
    for (const char c : argument) text += c == '\'' ? std::string("'\\''") : std::string(1, c);
    text += '\'';
  }
  return text;
}

}  // namespace exphoton::cli
