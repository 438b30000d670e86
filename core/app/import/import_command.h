// SPDX-License-Identifier: BSD-2-Clause
// RunImport is the command `exphoton import`: it converts a scene of version 3 or 4.
#pragma once

#include <string>
#include <vector>

namespace exphoton::cli {

// Returned if the scene was written, but something was replaced or left out.
inline constexpr int kImportIsInexact = 6;

// Returns the exit status.
int RunImport(const std::vector<std::string>& arguments);

}  // namespace exphoton::cli
