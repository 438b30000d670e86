// SPDX-License-Identifier: BSD-2-Clause
// `exphoton info` and `exphoton convert` process pictures without scenes. `arguments` exclude the
// names of the program and the command. The functions return the exit status.
#pragma once

#include <string>
#include <vector>

namespace exphoton::cli {

int RunInfo(const std::vector<std::string>& arguments);
int RunConvert(const std::vector<std::string>& arguments);

}  // namespace exphoton::cli
