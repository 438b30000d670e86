// SPDX-License-Identifier: BSD-2-Clause
// The program: which command was asked for, and the exit status of what went wrong.
#pragma once

#include <string>
#include <vector>

namespace exphoton::cli {

// `arguments` with the program's name first. Returns the exit status: 0 done; 1 command line; 2
// scene; 3 files; 4 resources; 5 internal; 128 + n on signal n.
int RunProgram(const std::vector<std::string>& arguments);

}  // namespace exphoton::cli
