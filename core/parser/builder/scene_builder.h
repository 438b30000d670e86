// SPDX-License-Identifier: BSD-2-Clause
// SceneBuilder turns directives into render setups. It keeps the state of the language: the open
// blocks, the current transformation and the named coordinate systems.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "core/parser/builder/error_collector.h"
#include "core/parser/builder/graphics_state.h"
#include "core/parser/builder/render_directives.h"
#include "core/parser/builder/world_builder.h"
#include "core/parser/render_setup.h"
#include "core/parser/syntax/parser.h"

namespace exphoton {

class SceneBuilder final : public DirectiveHandler {
 public:
  // `options` and `log` must outlive the builder. `log` must also outlive the setups.
  SceneBuilder(std::string sceneName, const LoadOptions& options, Dialect dialect, Log& log);

  // Errors of a directive are kept, and the next directive is handled (TakeErrors).
  void Handle(Directive directive) override;
  bool Keep(const Error& error) override;
  void Recover(const Directive& directive) override;
  void Finish(const SourceLocation& end) override;
  // Returns the errors found so far, followed by `last` if it is given.
  std::optional<Error> TakeErrors(const Error* last = nullptr) { return errors_.Take(last); }
  std::vector<std::unique_ptr<RenderSetup>> TakeSetups() { return std::move(setups_); }

 private:
  void HandleOrThrow(Directive directive);
  // Defines the name that a directive with an error would have defined, so that its uses cause no
  // further errors; begins its block; ends the world after a faulty WorldEnd.
  void RecoverFrom(const Directive& directive);
  // Closes blocks without an end, up to one of this kind.
  void EndOpenBlocks(StateStack::Block block);
  void DefineMissingTexture(const Directive& directive);
  void BeginMissingObject(const Directive& directive);
  // Drops errors about names and blocks that the file may have in text that cannot be read.
  void ExpectMissingNames();
  void CheckScope(const Directive& directive) const;
  void AddToWorldHash(const Directive& directive);
  void ChangeTransform(const Directive& directive);
  void SetActiveTransform(const Directive& directive);
  void SetTransformTimes(const Directive& directive);
  void UseCoordinateSystem(const Directive& directive);
  void HandleWorld(Directive directive);
  void SetMaterial(Directive directive);
  void MakeNamedMaterial(Directive directive);
  void UseNamedMaterial(const Directive& directive);
  void EndBlock(StateStack::Block block, const Directive& directive);
  void SetSearchPath(const Directive& directive);
  PluginFolder ClassifyPluginFolder(const std::string& path, const SourceLocation& where);
  void BeginWorld(const Directive& directive);
  void EndWorld(const Directive& directive);
  // Returns the log of the world between its beginning and its end, else the log of the setup.
  Log& CurrentLog() const { return world_ && options_.sceneLog ? *options_.sceneLog : log_; }
  void MakeRenderObjects(RenderSetup* setup);
  // Takes the scene of the known setup.
  void TakeKnownWorld(RenderSetup* setup);
  // Takes the scene at its end, and the names of its parts.
  void TakeWorld(const Directive& directive, RenderSetup* setup);
  void Reset();  // to the state at the beginning of a file

  std::string sceneName_;
  const LoadOptions& options_;
  Dialect dialect_;
  Log& log_;
  PluginFolders pluginFolders_;
  std::unique_ptr<PluginRegistry> registry_;

  std::optional<RenderDirectives> render_;
  std::optional<WorldBuilder> world_;  // set between WorldBegin and WorldEnd
  std::optional<SourceLocation> worldBegin_;
  GraphicsState state_;
  StateStack stack_;
  std::map<std::string, MovingTransform> coordinateSystems_;
  std::uint64_t hash_ = 0, worldHash_ = 0;  // see RenderSetup
  std::set<std::string> inputFiles_;
  std::shared_ptr<std::vector<Directive>> outside_;  // see RenderSetup
  ErrorCollector errors_;
  std::vector<std::unique_ptr<RenderSetup>> setups_;
};

}  // namespace exphoton
