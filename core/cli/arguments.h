// SPDX-License-Identifier: BSD-2-Clause
// CLI11 with our errors: help and version as TextRequest, everything else as usage errors.
#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace exphoton::cli {

void ParseArguments(CLI::App& app, const std::vector<std::string>& arguments);

}  // namespace exphoton::cli
