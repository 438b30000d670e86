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
  // Returns whether it has kept the error, so that parsing goes on at the next directive. If not,
  // ParseScene throws the error.
  virtual bool Keep(const Error&) { return false; }
  // Called after an error was kept, with the parts of the directive that are known. The
  // specification of a misspelt directive is the nearest one; null: no directive is near.
  virtual void Recover(const Directive&) {}
  // Called after the last directive; `end` is the end of the file. Not called if the file ends in a
  // list without an end.
  virtual void Finish(const SourceLocation& end) = 0;
  virtual SceneGrammar Grammar() const { return SceneGrammar::Early; }
};

// Throws Error(File) if `path` cannot be read and Error(Scene) for syntax errors. Logs warnings,
// for example for a parameter given twice.
void ParseScene(SceneSource& source, const std::string& path, DirectiveHandler& handler, Log& log,
                const SceneLimits& limits = {});

}  // namespace exphoton
