// SPDX-License-Identifier: BSD-2-Clause
// ImportText and its relatives convert scenes of versions 3 and 4 in memory.
#pragma once

#include <map>
#include <optional>
#include <sstream>
#include <string>

#include "core/app/import/import_report.h"
#include "core/app/import/scene_import.h"
#include "tests/parser/parse_support.h"

namespace exphoton::cli {

struct Imported {
  std::string text, messages, error;
  int version = 0;
  bool isExact = false;
  std::map<std::string, std::string> skyMaps;

  // Returns the line that begins with these words, without indentation; "" if there is none.
  std::string Line(const std::string& begin) const {
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
      line.erase(0, line.find_first_not_of(' '));
      if (line.starts_with(begin)) return line;
    }
    return "";
  }
  int Count(const std::string& part) const {
    int count = 0;
    for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1))
      ++count;
    return count;
  }
};

inline Imported ImportFiles(const Files& files, std::optional<int> version = {}) {
  Imported result;
  Log log(Log::Level::Normal, Log::Sink::Memory);
  ImportReport report(log);
  MemorySource source(files);
  try {
    ImportedScene scene = ImportScene(source, {"scene.pbrt", "new.pbrt", version, {}}, report, log);
    result.text = scene.text;
    result.version = scene.version;
    result.skyMaps = scene.skyMaps;
  } catch (const Error& error) {
    result.error = Diagnostic(error);
  }
  for (const std::string& message : log.Messages()) result.messages += message;
  result.isExact = report.IsExact();
  return result;
}
inline Imported ImportText(const std::string& text, std::optional<int> version = {}) {
  return ImportFiles({{"scene.pbrt", text}}, version);
}

inline const std::string kHead3 =
    "Film \"image\" \"integer xresolution\" 4 \"integer yresolution\" 4\n"
    "Integrator \"path\"\nPixelFilter \"box\"\nSampler \"halton\"\nWorldBegin\n";
inline const std::string kHead4 =
    "Film \"rgb\" \"integer xresolution\" 4 \"integer yresolution\" 4\n"
    "Integrator \"path\"\nPixelFilter \"box\"\nSampler \"halton\"\nWorldBegin\n";
inline Imported World3(const std::string& world) {
  return ImportText(kHead3 + world + "\nWorldEnd\n");
}
inline Imported World4(const std::string& world) { return ImportText(kHead4 + world + "\n"); }

}  // namespace exphoton::cli
