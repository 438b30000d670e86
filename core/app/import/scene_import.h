// SPDX-License-Identifier: BSD-2-Clause
// ImportScene converts a scene of version 3 or 4 to the text of a scene of version 1.
#pragma once

#include <map>
#include <optional>
#include <string>

#include "core/app/import/import_report.h"
#include "core/parser/syntax/scene_limits.h"
#include "core/parser/syntax/source.h"

namespace exphoton::cli {

struct ImportTask {
  std::string sceneFile, outputFile;
  std::optional<int> version;  // 3 or 4; absent: recognised by the directives
  SceneLimits limits;
};

struct ImportedScene {
  std::string text;
  int version = 3;
  // Maps of infinite lights that must be written as maps of latitude and longitude: the source,
  // and the name beside the converted scene.
  std::map<std::string, std::string> skyMaps;
};

// Throws Error. `report` lists everything that is not exact.
ImportedScene ImportScene(SceneSource& source, const ImportTask& task, ImportReport& report,
                          Log& log);

}  // namespace exphoton::cli
