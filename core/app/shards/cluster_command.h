// SPDX-License-Identifier: BSD-2-Clause
// RunCluster is the command `exphoton cluster`: it writes scripts that render a picture in shards
// with a scheduler, and submits them on request.
#pragma once

#include <string>
#include <vector>

namespace exphoton::cli {

int RunCluster(const std::vector<std::string>& arguments);

}  // namespace exphoton::cli
