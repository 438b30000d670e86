// SPDX-License-Identifier: BSD-2-Clause
// These helpers convert scene text in memory to tokens, directives, scenes, or the diagnostic that
// a user would read.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "core/base/error.h"
#include "core/base/log.h"
#include "core/parser/render_setup.h"
#include "core/parser/syntax/parser.h"

namespace exphoton {

using Files = std::map<std::string, std::string>;

// DirectiveList stores the directives that the parser emits.
class DirectiveList final : public DirectiveHandler {
 public:
  void Handle(Directive directive) override { directives.push_back(std::move(directive)); }
  void Finish(const SourceLocation&) override {}
  std::vector<Directive> directives;
};

inline std::string Diagnostic(const Error& error) {
  return FormatDiagnostic("error", error.what(), error.Where(), error.Hint());
}

// Returns the directives of the file "scene.pbrt". Throws Error.
inline std::vector<Directive> ParseFiles(const Files& files, Log* log = nullptr) {
  Log quiet(Log::Level::Normal, Log::Sink::Memory);
  MemorySource source(files);
  DirectiveList list;
  ParseScene(source, "scene.pbrt", list, log ? *log : quiet);
  return std::move(list.directives);
}
inline std::vector<Directive> ParseText(const std::string& text) {
  return ParseFiles({{"scene.pbrt", text}});
}

// Returns the diagnostic of parsing alone, or "" if there is no error.
inline std::string ParseErrorOf(const Files& files) {
  try {
    ParseFiles(files);
  } catch (const Error& error) {
    return Diagnostic(error);
  }
  return "";
}
inline std::string ParseErrorOf(const std::string& text) {
  return ParseErrorOf(Files{{"scene.pbrt", text}});
}

// BuiltScene is the result of building a scene in full, with all messages of the build.
struct BuiltScene {
  std::unique_ptr<Log> log = std::make_unique<Log>(Log::Level::Normal, Log::Sink::Memory);
  std::vector<std::unique_ptr<RenderSetup>> setups;
  std::string error;  // the diagnostic; "" if the scene was built
  int status = 0;

  std::string Messages() const {
    std::string all;
    for (const std::string& message : log->Messages()) all += message;
    return all;
  }
};
inline BuiltScene BuildText(const std::string& text, LoadOptions options = {}) {
  BuiltScene built;
  options.pluginFolders.push_back(std::string(EXPHOTON_BINARY_DIR) + "/plugins");
  MemorySource source({{"scene.pbrt", text}});
  try {
    built.setups = LoadScenes(source, "scene.pbrt", options, *built.log);
  } catch (const Error& error) {
    built.error = Diagnostic(error);
    for (const Error& other : error.Others()) built.error += Diagnostic(other);
    built.status = int(error.Status());
  }
  return built;
}

// Wraps the text in a world with a small film and an accelerator that is quick to build.
inline std::string InWorld(const std::string& text) {
  return "Film \"image\" \"integer xresolution\" 4 \"integer yresolution\" 4\n"
         "Accelerator \"bruteforce\"\nWorldBegin\n" +
         text + "\nWorldEnd\n";
}

}  // namespace exphoton
