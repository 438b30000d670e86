// SPDX-License-Identifier: BSD-2-Clause
// The files that a scene file reads and writes, from its directives alone: no plugin is loaded and
// no object is made.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "core/parser/render_setup.h"
#include "core/parser/syntax/directive.h"
#include "core/parser/syntax/source.h"

namespace exphoton {

struct SceneFiles {
  std::set<std::string> inputs;       // the file itself, includes, files that parameters name
  std::vector<std::string> pictures;  // names that its Films give, one for each world
  bool isWhole = false;               // false where an error ended the reading
};

// Adds the files that a directive's strings name, as far as they exist.
void NoteInputFiles(const Directive& directive, std::set<std::string>* files);

// Does not throw for what is wrong in the file. Throws Error(CommandLine) for wrong options.
SceneFiles ScanScene(SceneSource& source, const std::string& path, const LoadOptions& options);

}  // namespace exphoton
