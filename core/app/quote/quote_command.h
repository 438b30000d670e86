// SPDX-License-Identifier: BSD-2-Clause
// RunQuote is the command `exphoton quote`: it predicts what accuracies cost in a scene, from
// renders of a few seconds.
#pragma once

#include <string>
#include <vector>

namespace exphoton::cli {

// `arguments` exclude the names of program and command. Returns the exit status.
int RunQuote(const std::vector<std::string>& arguments);

}  // namespace exphoton::cli
