// SPDX-License-Identifier: BSD-2-Clause
// RunProgram runs the command that the arguments name and turns every failure into an exit status.
#pragma once

#include <string>
#include <vector>

namespace exphoton::cli {

// `arguments` begin with the program's name. Returns the exit status: 0 success; 1 command line; 2
// scene; 3 files; 4 resources; 5 internal; 128 + n on signal n. The compare command differs.
int RunProgram(const std::vector<std::string>& arguments);

}  // namespace exphoton::cli
