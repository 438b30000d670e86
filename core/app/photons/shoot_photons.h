// SPDX-License-Identifier: BSD-2-Clause
// RunPhotons is the command `exphoton photons`: it shoots the photons of a scene into a file, which
// renders of the same scene from any camera can use (render --photons).
#pragma once

#include <string>
#include <vector>

namespace exphoton::cli {

// `arguments` exclude the names of program and command. Returns the exit status.
int RunPhotons(const std::vector<std::string>& arguments);

}  // namespace exphoton::cli
