// SPDX-License-Identifier: BSD-2-Clause
// ScanScene lists the files that a scene file reads and writes. It parses the directives only: it
// loads no plugin and makes no scene objects.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "core/parser/render_setup.h"
#include "core/parser/syntax/directive.h"
#include "core/parser/syntax/source.h"

namespace exphoton {

struct SceneFiles {
  std::set<std::string> inputs;       // the scene file, its includes, files that parameters name
  std::vector<std::string> pictures;  // picture names from Film, one for each world
  bool isWhole = false;               // false if an error stopped the scan
};

// Adds every existing file that a string parameter of the directive names.
void NoteInputFiles(const Directive& directive, std::set<std::string>* files);

// Does not throw for errors in the file. Throws LoadingStopped if options.stop is set.
SceneFiles ScanScene(SceneSource& source, const std::string& path, const LoadOptions& options);

}  // namespace exphoton
