// SPDX-License-Identifier: BSD-2-Clause
// RunMerge is the command `exphoton merge`: it makes a picture from the parts of its shards, or
// lists the parts that are missing.
#pragma once

#include <string>
#include <vector>

namespace exphoton::cli {

int RunMerge(const std::vector<std::string>& arguments, const std::string& commandLine);

}  // namespace exphoton::cli
