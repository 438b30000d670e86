// SPDX-License-Identifier: BSD-2-Clause
// `exphoton plugins`: what can be named in a scene, and with which parameters.
#pragma once

#include <string>
#include <vector>

namespace exphoton::cli {

// `arguments` without the program's and the command's name; returns the exit status.
int RunPlugins(const std::vector<std::string>& arguments);

}  // namespace exphoton::cli
