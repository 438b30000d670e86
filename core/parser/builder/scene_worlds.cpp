// SPDX-License-Identifier: BSD-2-Clause
// SceneBuilder completes a render setup at WorldEnd. LoadScenes parses a file with a SceneBuilder.
#include <algorithm>
#include <iterator>
#include <utility>

#include "core/base/log.h"
#include "core/parser/builder/scene_builder.h"
#include "core/parser/dialect.h"
#include "core/parser/effect_choice.h"
#include "core/parser/later_version.h"

namespace exphoton {

void SceneBuilder::BeginWorld(const Directive& directive) {
  worldBegin_ = directive.Where();
  render_->SetDefaultLocation(directive.Where());
  AcceleratorSpec accelerator{"bvh", {}, options_.threads};
  errors_.Try([&] { accelerator = render_->Accelerator(*registry_); });
  Log& log = options_.sceneLog ? *options_.sceneLog : log_;
  world_.emplace(*registry_, log, options_, dialect_, std::move(accelerator),
                 render_->TransformTimes());
  registry_->SetLog(&log);
  state_.transform = MovingTransform();
  state_.active = ActiveTimes::All;
  if (!coordinateSystems_.contains("camera")) coordinateSystems_["camera"] = MovingTransform();
  coordinateSystems_["world"] = MovingTransform();
  state_.material = std::make_shared<MaterialSpec>();  // instantiated only if a shape uses it
  state_.material->name = "matte";
  state_.material->params.where = directive.Where();
}

void SceneBuilder::EndWorld(const Directive& directive) {
  if (world_->IsInObject())
    FailDependent(directive.Where(), "the object that begins at " +
                                         LocationText(stack_.Innermost()) + " has no ObjectEnd");
  if (!stack_.IsEmpty())
    CurrentLog().Warning(std::string(stack_.InnermostName()) + " without its end",
                         stack_.Innermost());

  auto setup = std::make_unique<RenderSetup>();
  setup->sceneName = sceneName_;
  setup->sceneHash = hash_;
  setup->worldHash = worldHash_;
  setup->dialect = dialect_;
  setup->inputFiles.assign(inputFiles_.begin(), inputFiles_.end());
  setup->outside = outside_;
  MakeRenderObjects(setup.get());
  if (!errors_.IsEmpty()) return Reset();  // no time is spent on a scene that will not be rendered
  if (options_.known)
    TakeKnownWorld(setup.get());
  else
    TakeWorld(directive, setup.get());
  RequiredFeatures plan =
      ChooseEffects(FindRequiredFeatures(*setup->scene, *setup->camera), options_.effects, log_);
  plan.KeepComputed(setup->integrator->ComputedFeatures());
  NoteTimes(*setup->scene, *setup->camera, &plan);
  setup->scene->SetFeatures(std::move(plan), setup->camera->Shutter());
  setups_.push_back(std::move(setup));
  Reset();
}

namespace {

using Names = std::vector<std::string>;  // sorted

Names Union(const Names& a, const Names& b) {
  Names all;
  std::ranges::set_union(a, b, std::back_inserter(all));
  return all;
}

Names Without(const Names& all, const Names& some) {
  Names rest;
  std::ranges::set_difference(all, some, std::back_inserter(rest));
  return rest;
}

}  // namespace

void SceneBuilder::MakeRenderObjects(RenderSetup* setup) {
  const bool hasMedia = options_.known ? options_.known->scene->HasMedia() : world_->HasMedia();
  setup->worldPlugins = registry_->Loaded();
  registry_->SetLog(&log_);
  render_->Create(*registry_, log_, hasMedia, setup, &errors_);
  setup->plugins = registry_->Loaded();
}

void SceneBuilder::TakeKnownWorld(RenderSetup* setup) {
  RenderSetup& known = *options_.known;
  setup->scene = std::move(known.scene);
  setup->names = std::move(known.names);
  setup->inputFiles = known.inputFiles;
  setup->sceneHash = known.sceneHash;
  setup->worldHash = known.worldHash;
  setup->worldPlugins = known.worldPlugins;
  setup->plugins = Union(setup->plugins, known.worldPlugins);
}

void SceneBuilder::TakeWorld(const Directive& directive, RenderSetup* setup) {
  registry_->SetLog(&CurrentLog());
  setup->names = world_->Names();
  SceneParts parts = world_->Take();  // which may load an accelerator
  setup->worldPlugins = Union(setup->worldPlugins, Without(registry_->Loaded(), setup->plugins));
  setup->plugins = registry_->Loaded();
  for (const Statistics::Phase& phase : world_->Times().Phases()) {
    setup->acceleratorSeconds += phase.wallSeconds;
    setup->acceleratorCpuSeconds += phase.cpuSeconds;
  }
  const bool glows = std::any_of(parts.media.begin(), parts.media.end(),
                                 [](const auto& medium) { return medium->Emits(); });
  setup->scene = std::make_unique<Scene>(std::move(parts));
  if (setup->scene->NonBlackLightCount() == 0 && !glows)
    CurrentLog().Warning(setup->scene->Lights().empty() ? "the scene has no light"
                                                        : "all lights of the scene are black",
                         directive.Where());
}

void SceneBuilder::Finish(const SourceLocation& end) {
  errors_.Try([&] {
    if (world_)
      FailDependent(end, "WorldEnd is missing: the world begins at " + LocationText(*worldBegin_));
    if (setups_.empty() && errors_.IsEmpty())
      FailAt(end, "the file has no WorldBegin: there is nothing to render");
  });
}

namespace {

// Adds all files that the source has read, since an included file can affect several scenes.
void AddFilesRead(const SceneSource& source, RenderSetup* setup) {
  std::set<std::string> files = source.FilesRead();
  files.insert(setup->inputFiles.begin(), setup->inputFiles.end());
  setup->inputFiles.assign(files.begin(), files.end());
}

// Parses the file to its end, or to an error after which reading cannot go on, and throws all
// errors found.
void ParseAll(SceneSource& source, const std::string& path, const LoadOptions& options, Log& log,
              SceneBuilder* builder) {
  try {
    ParseScene(source, path, *builder, log, options.limits);
  } catch (const Error& error) {
    // The collector throws errors with the others attached; those of the tokenizer come alone.
    if (!error.Others().empty() || error.Status() == ExitStatus::Resource) throw;
    throw *builder->TakeErrors(&error);
  }
  if (const std::optional<Error> error = builder->TakeErrors()) throw *error;
}

std::vector<std::unique_ptr<RenderSetup>> ReadScenes(SceneSource& source, const std::string& path,
                                                     const LoadOptions& options, Log& log) {
  RefuseLaterVersion(source, path, options);
  Log& logOfText = options.sceneLog ? *options.sceneLog : log;
  const Dialect dialect =
      options.dialect ? *options.dialect : RecogniseDialect(source, path, options, logOfText);
  SceneBuilder builder(path == "-" ? "<stdin>" : path, options, dialect, log);
  ParseAll(source, path, options, logOfText, &builder);
  std::vector<std::unique_ptr<RenderSetup>> setups = builder.TakeSetups();
  for (const auto& setup : setups) AddFilesRead(source, setup.get());
  return setups;
}

// Makes another setup from the directives outside the world of the known one.
std::vector<std::unique_ptr<RenderSetup>> MakeAgain(const LoadOptions& options, Log& log) {
  const RenderSetup& known = *options.known;
  SceneBuilder builder(known.sceneName, options, known.dialect, log);
  const auto outside = known.outside;
  for (const Directive& directive : *outside) builder.Handle(directive);
  if (const std::optional<Error> error = builder.TakeErrors()) throw *error;
  return builder.TakeSetups();
}

}  // namespace

std::vector<std::unique_ptr<RenderSetup>> LoadScenes(SceneSource& source, const std::string& path,
                                                     const LoadOptions& options, Log& log) {
  try {
    return options.known ? MakeAgain(options, log) : ReadScenes(source, path, options, log);
  } catch (const Error& error) {
    const bool isCommandLine = error.Where() && error.Where()->file == kCommandLineLocation;
    if (!isCommandLine || error.Status() == ExitStatus::CommandLine) throw;
    Error ofCommandLine(ExitStatus::CommandLine, error.what(), *error.Where(), error.Hint());
    ofCommandLine.AddOthers(error.Others());
    throw ofCommandLine;
  }
}

}  // namespace exphoton
