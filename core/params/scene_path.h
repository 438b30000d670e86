// SPDX-License-Identifier: BSD-2-Clause
// Names of files in scene files.
#pragma once

#include <string>

#include "core/base/error.h"

namespace exphoton {

// The path that `name`, written at `where`, stands for: relative to the folder of the scene file
// that it stands in; an absolute one stays.
std::string ResolveScenePath(const std::string& name, const SourceLocation& where);

}  // namespace exphoton
