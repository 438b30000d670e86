// SPDX-License-Identifier: BSD-2-Clause
// TakeAccuracy reads the option --accuracy, and checks it against the other options.
#pragma once

#include <string>

#include "core/app/options/options.h"

namespace exphoton::cli {

// percentage: as the user gave it; "": not given. The other options but --shard must be in the
// command. Throws Error(CommandLine).
void TakeAccuracy(const std::string& percentage, RenderCommand* command);

}  // namespace exphoton::cli
