// SPDX-License-Identifier: BSD-2-Clause
// `exphoton check-plugin` checks a material, a light or a sampler, for its author.
#pragma once

#include <string>
#include <vector>

namespace exphoton::cli {

// `arguments` exclude the names of the program and the command. Returns the exit status: 1 if a
// check fails.
int RunCheckPlugin(const std::vector<std::string>& arguments);

}  // namespace exphoton::cli
