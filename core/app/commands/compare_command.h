// SPDX-License-Identifier: BSD-2-Clause
// `exphoton compare` measures the difference between pictures and a reference. `arguments` exclude
// the names of the program and the command.
#pragma once

#include <string>
#include <vector>

namespace exphoton::cli {

// Returns 0 if all pictures match, 1 if one differs and 2 if they cannot be compared.
int RunCompare(const std::vector<std::string>& arguments);

}  // namespace exphoton::cli
