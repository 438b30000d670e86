// SPDX-License-Identifier: BSD-2-Clause
// LaterReader parses an imported file as a scene of its own.
#include "core/app/import/reading/later_reader.h"

#include <algorithm>

#include "core/params/scene_path.h"

namespace exphoton::cli {

void LaterReader::Read(const std::string& path) {
  files_ = {path};
  ParseScene(source_, path, *this, log_, limits_);
}

void LaterReader::Handle(Directive directive) {
  if (directive.spec->id == DirectiveId::Import) return Import(directive);
  state_.Handle(directive);
  Visit(directive);
}

void LaterReader::Finish(const SourceLocation& end) {
  if (files_.size() > 1) return;
  state_.CheckEnd(end);
  End(end);
}

void LaterReader::Block(const char* name, const SourceLocation& where) {
  Directive directive;
  directive.spec = FindDirective(name, SceneGrammar::Later);
  directive.params.where = where;
  Handle(std::move(directive));
}

void LaterReader::Import(const Directive& directive) {
  const std::string& name = directive.strings[0];
  const std::vector<std::string> candidates =
      ScenePathCandidates(name, directive.Where().file, files_.front());
  const auto found = std::find_if(candidates.begin(), candidates.end(),
                                  [&](const std::string& path) { return source_.Has(path); });
  if (found == candidates.end())
    throw Error(ExitStatus::Scene, "cannot read the imported file \"" + name + "\"",
                directive.Where(), TriedPathsText(candidates));
  if (std::find(files_.begin(), files_.end(), *found) != files_.end())
    throw Error(ExitStatus::Scene, "the file imports itself: \"" + name + "\"", directive.Where());
  Block("AttributeBegin", directive.Where());
  files_.push_back(*found);
  ParseScene(source_, *found, *this, log_, limits_);
  files_.pop_back();
  Block("AttributeEnd", directive.Where());
}

}  // namespace exphoton::cli
