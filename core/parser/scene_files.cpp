// SPDX-License-Identifier: BSD-2-Clause
// FileCollector handles directives by recording file names only.
#include "core/parser/scene_files.h"

#include <filesystem>
#include <new>

#include "core/base/log.h"
#include "core/params/scene_path.h"
#include "core/parser/syntax/parser.h"

namespace exphoton {
namespace {

class FileCollector final : public DirectiveHandler {
 public:
  FileCollector(const LoadOptions& options, SceneFiles* files) : options_(options), files_(files) {}

  void Handle(Directive directive) override {
    if (options_.stop && *options_.stop) throw LoadingStopped();
    NoteInputFiles(directive, &files_->inputs);
    if (directive.spec->id == DirectiveId::Film) {
      const ParsedParam* const name = directive.params.Find("filename");
      picture_ = name && name->strings.size() == 1 ? name->strings[0] : FilmSettings().filename;
    } else if (directive.spec->id == DirectiveId::WorldEnd) {
      files_->pictures.push_back(picture_);
      picture_ = FilmSettings().filename;
    }
  }
  void Finish(const SourceLocation&) override { files_->isWhole = true; }

 private:
  const LoadOptions& options_;
  SceneFiles* files_;
  std::string picture_ = FilmSettings().filename;
};

}  // namespace

void NoteInputFiles(const Directive& directive, std::set<std::string>* files) {
  if (directive.spec->id == DirectiveId::Film) return;
  for (const ParsedParam& param : directive.params.All()) {
    if (param.type != "string" && param.type != "spectrum") continue;
    for (const std::string& text : param.strings) {
      const std::string path = ResolveScenePath(text, param.where);
      std::error_code ignored;
      if (std::filesystem::is_regular_file(path, ignored)) files->insert(path);
    }
  }
}

SceneFiles ScanScene(SceneSource& source, const std::string& path, const LoadOptions& options) {
  SceneFiles files;
  Log silent(Log::Level::Quiet, Log::Sink::Memory);
  try {
    FileCollector collector(options, &files);
    ParseScene(source, path, collector, silent, options.limits);
  } catch (const Error&) {
    // LoadScenes reports the error later, when it loads the scene.
  }
  files.inputs.merge(source.FilesRead());
  return files;
}

}  // namespace exphoton
