// SPDX-License-Identifier: BSD-2-Clause
// Arguments as one line of text.
#pragma once

#include <string>
#include <vector>

namespace exphoton::cli {

// Words as a shell would need them, so that the line can be pasted.
std::string CommandLineText(const std::vector<std::string>& arguments);

}  // namespace exphoton::cli
