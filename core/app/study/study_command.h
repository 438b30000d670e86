// SPDX-License-Identifier: BSD-2-Clause
// `exphoton study` and `exphoton report`. `arguments` without the program's and the command's name;
// the result is the exit status.
#pragma once

#include <string>
#include <vector>

namespace exphoton::cli {

// commandLine: as it was typed.
int RunStudy(const std::vector<std::string>& arguments, const std::string& commandLine);
int RunReport(const std::vector<std::string>& arguments);

}  // namespace exphoton::cli
