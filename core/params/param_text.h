// SPDX-License-Identifier: BSD-2-Clause
// NumberText formats numbers for messages and listings.
#pragma once

#include <string>

namespace exphoton {

// Returns the shortest text that parses to this number: "0.1" for the float nearest to 0.1. Returns
// "infinity" or "nan" for such values.
std::string NumberText(double v);

}  // namespace exphoton
