// SPDX-License-Identifier: BSD-2-Clause
// RunStudy and RunReport implement `exphoton study` and `exphoton report`. `arguments` exclude the
// names of the program and the command. The functions return the exit status.
#pragma once

#include <string>
#include <vector>

namespace exphoton::cli {

// `commandLine` is the full command as typed.
int RunStudy(const std::vector<std::string>& arguments, const std::string& commandLine);
int RunReport(const std::vector<std::string>& arguments);

}  // namespace exphoton::cli
