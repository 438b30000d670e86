// SPDX-License-Identifier: BSD-2-Clause
// ParseScene: scene text to directives, one after the other. It knows how each is written, not what
// it means, nor where it may stand.
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
  // After the last directive; `end` is the end of the file.
  virtual void Finish(const SourceLocation& end) = 0;
};

// Throws Error(File) where `path` cannot be read, Error(Scene) for what is wrong in it. The log
// gets the warnings (a parameter given twice).
void ParseScene(SceneSource& source, const std::string& path, DirectiveHandler& handler, Log& log,
                const SceneLimits& limits = {});

}  // namespace exphoton
