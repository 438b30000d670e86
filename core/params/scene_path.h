// SPDX-License-Identifier: BSD-2-Clause
// Resolves the file names in scene files. Version 1 of the scene language looks them up from the
// working folder, version 2 from the folder of the main scene file, and most exporters expect the
// folder of the file that contains the name. All three are tried.
#pragma once

#include <string>
#include <vector>

#include "core/base/error.h"

namespace exphoton {

// Returns the paths that a file `name`, written in scene file `from`, may have, in the order in
// which they are tried: in the folder of `from`, in the folder of the main scene file, in the
// working folder. An absolute name has one path.
std::vector<std::string> ScenePathCandidates(const std::string& name, const std::string& from,
                                             const std::string& mainFile);

// Returns the first of these paths that exists, or the first path if none exists. `where` is the
// location of the name.
std::string ResolveScenePath(const std::string& name, const SourceLocation& where);

// Returns the hint of an error about a missing file: the paths that were tried.
std::string TriedPathsText(const std::vector<std::string>& candidates);

// Returns the text of a ParamError about a file that cannot be read: "names \"a.exr\", which cannot
// be read: no such file". `fault` begins with the path and a colon, or is only the reason.
std::string UnreadableFileText(const std::string& path, const std::string& fault);

// Returns the file that includes, directly or not, the file of this location.
const std::string& MainFileOf(const SourceLocation& where);

}  // namespace exphoton
