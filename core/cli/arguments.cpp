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

}  // namespace exphoton::cli
