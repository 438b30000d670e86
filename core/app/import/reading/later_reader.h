// SPDX-License-Identifier: BSD-2-Clause
// LaterReader reads a scene of version 3 or 4 with all files that it includes or imports. It keeps
// the graphics state and hands each directive to Visit.
#pragma once

#include <string>
#include <vector>

#include "core/app/import/reading/later_state.h"
#include "core/parser/syntax/parser.h"

namespace exphoton::cli {

class LaterReader : public DirectiveHandler {
 public:
  LaterReader(SceneSource& source, Log& log, const SceneLimits& limits)
      : source_(source), log_(log), limits_(limits) {}

  void Read(const std::string& path);

  SceneGrammar Grammar() const final { return SceneGrammar::Later; }
  void Handle(Directive directive) final;
  void Finish(const SourceLocation& end) final;

 protected:
  // Called after the state has changed. An imported file arrives between two directives
  // AttributeBegin and AttributeEnd, because what it sets does not outlive it.
  virtual void Visit(const Directive& directive) = 0;
  virtual void End(const SourceLocation& end) = 0;
  const LaterState& State() const { return state_; }
  LaterState& State() { return state_; }

 private:
  void Import(const Directive& directive);
  void Block(const char* name, const SourceLocation& where);

  SceneSource& source_;
  Log& log_;
  const SceneLimits& limits_;
  LaterState state_;
  std::vector<std::string> files_;  // that are being read: the scene and its imports
};

}  // namespace exphoton::cli
