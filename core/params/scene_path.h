// SPDX-License-Identifier: BSD-2-Clause
// ResolveScenePath resolves the file names in scene files.
#pragma once

#include <string>

#include "core/base/error.h"

namespace exphoton {

// Returns the path of the file `name`, written at `where`. A relative name is relative to the
// folder of its scene file. An absolute name is returned unchanged.
std::string ResolveScenePath(const std::string& name, const SourceLocation& where);

}  // namespace exphoton
