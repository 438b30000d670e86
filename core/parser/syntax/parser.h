// SPDX-License-Identifier: BSD-2-Clause
// ParseScene converts scene text to a sequence of directives. It checks the syntax of each
// directive, but neither its meaning nor the scope that allows it.
#pragma once

#include <string>

#include "core/parser/syntax/directive.h"
#include "core/parser/syntax/scene_limits.h"
#include "core/parser/syntax/source.h"

namespace exphoton {

class Log;

class DirectiveHandler {
 public:
  virtual ~DirectiveHandler() = default;
  virtual void Handle(Directive directive) = 0;
  // Called after the last directive; `end` is the end of the file.
  virtual void Finish(const SourceLocation& end) = 0;
  virtual SceneGrammar Grammar() const { return SceneGrammar::Early; }
};

// Throws Error(File) if `path` cannot be read and Error(Scene) for syntax errors. Logs warnings,
// for example for a parameter given twice.
void ParseScene(SceneSource& source, const std::string& path, DirectiveHandler& handler, Log& log,
                const SceneLimits& limits = {});

}  // namespace exphoton
