// SPDX-License-Identifier: BSD-2-Clause
// `exphoton plugins` lists the plugins that a scene can name, and their parameters.
#pragma once

#include <string>
#include <vector>

namespace exphoton::cli {

// `arguments` exclude the names of the program and the command. Returns the exit status.
int RunPlugins(const std::vector<std::string>& arguments);

}  // namespace exphoton::cli
