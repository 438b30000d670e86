// SPDX-License-Identifier: BSD-2-Clause
// RunBudget is the command `exphoton budget`: it splits the error of a scene's picture by cause.
#pragma once

#include <string>
#include <vector>

namespace exphoton::cli {

// `arguments` exclude the names of program and command. Returns the exit status.
int RunBudget(const std::vector<std::string>& arguments);

}  // namespace exphoton::cli
