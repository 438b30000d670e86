// SPDX-License-Identifier: BSD-2-Clause
// ImportContext holds the facts about the whole scene that converting one directive needs.
#pragma once

#include <map>
#include <string>

#include "core/app/import/import_report.h"

namespace exphoton::cli {

struct ImportContext {
  int version = 3;              // of the scene: 3 or 4
  bool writesVersion2 = false;  // a blend of named materials needs version 2, else version 1
  double lightFactor = 1;       // the film's factor on all light
  std::string outputFile;       // the converted scene
  // Files that the converted scene needs: their source and, relative to the scene, their name.
  std::map<std::string, std::string>& skyMaps;
  ImportReport& report;
};

// Returns the name of a file of the scene, as the converted scene must give it in its own folder.
// Reports a file that does not exist.
std::string FileNameFor(const std::string& name, const SourceLocation& where,
                        const ImportContext& context);

}  // namespace exphoton::cli
