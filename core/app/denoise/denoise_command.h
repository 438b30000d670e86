// SPDX-License-Identifier: BSD-2-Clause
// RunDenoise is the command `exphoton denoise`: it filters the noise of a rendered picture.
#pragma once

#include <string>
#include <vector>

namespace exphoton::cli {

// Returns the exit status.
int RunDenoise(const std::vector<std::string>& arguments);

}  // namespace exphoton::cli
