// SPDX-License-Identifier: BSD-2-Clause
// `exphoton compare`: how far pictures are from a reference. `arguments` without the program's and
// the command's name.
#pragma once

#include <string>
#include <vector>

namespace exphoton::cli {

// 0: all the same; 1: one differs; 2: they cannot be compared.
int RunCompare(const std::vector<std::string>& arguments);

}  // namespace exphoton::cli
