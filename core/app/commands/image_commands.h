// SPDX-License-Identifier: BSD-2-Clause
// `exphoton info` and `convert`: pictures without scenes. `arguments` without the
// program's and the command's name; the result is the exit status.
#pragma once

#include <string>
#include <vector>

namespace exphoton::cli {

int RunInfo(const std::vector<std::string>& arguments);
int RunConvert(const std::vector<std::string>& arguments);

}  // namespace exphoton::cli
