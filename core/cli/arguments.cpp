// SPDX-License-Identifier: BSD-2-Clause
// From CLI11's exceptions to ours.
#include "core/cli/arguments.h"

#include <CLI/CLI.hpp>

#include "core/cli/options.h"
#include "core/cli/values.h"

namespace exphoton::cli {

void ParseArguments(CLI::App& app, const std::vector<std::string>& arguments) {
  try {
    app.parse(std::vector<std::string>(arguments.rbegin(), arguments.rend()));
  } catch (const CLI::CallForHelp&) {
    throw TextRequest{app.help()};
  } catch (const CLI::CallForVersion&) {
    throw TextRequest{VersionText() + "\n"};
  } catch (const CLI::ParseError& error) {
    FailUsage(error.what(), "--help lists the options");
  }
}

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
