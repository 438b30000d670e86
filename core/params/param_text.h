// SPDX-License-Identifier: BSD-2-Clause
// Numbers in messages and listings.
#pragma once

#include <string>

namespace exphoton {

// The shortest text that means this number: "0.1" for the float nearest to it; "infinity", "nan".
std::string NumberText(double v);

}  // namespace exphoton
