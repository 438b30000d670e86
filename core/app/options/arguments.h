// SPDX-License-Identifier: BSD-2-Clause
// CommandLineText joins arguments into one line of text.
#pragma once

#include <string>
#include <vector>

namespace exphoton::cli {

// Quotes the arguments for a POSIX shell, so that the line can be pasted.
std::string CommandLineText(const std::vector<std::string>& arguments);

}  // namespace exphoton::cli
