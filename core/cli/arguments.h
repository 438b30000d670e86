// SPDX-License-Identifier: BSD-2-Clause
// CLI11 with our errors: help and version as TextRequest, everything else as usage errors; and
// arguments as one line of text.
#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace exphoton::cli {

void ParseArguments(CLI::App& app, const std::vector<std::string>& arguments);

// Words as a shell would need them, so that the line can be pasted.
std::string CommandLineText(const std::vector<std::string>& arguments);

}  // namespace exphoton::cli
