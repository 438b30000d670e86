// SPDX-License-Identifier: BSD-2-Clause
// SceneBuilder is the state machine of the scene language. WorldEnd adds a RenderSetup and resets
// the state.
#include "core/parser/builder/scene_builder.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/base/log.h"
#include "core/files/file_identity.h"
#include "core/params/suggestions.h"
#include "core/parser/builder/transform_directives.h"
#include "core/parser/overrides.h"
#include "core/parser/scene_files.h"
#include "core/parser/scene_hash.h"
#include "core/scene/required_features.h"

namespace exphoton {

SceneBuilder::SceneBuilder(std::string sceneName, const LoadOptions& options, Dialect dialect,
                           Log& log)
    : sceneName_(std::move(sceneName)), options_(options), dialect_(dialect), log_(log) {
  CheckOverrides(options_.parameters);
  Reset();
}

void SceneBuilder::Reset() {
  pluginFolders_ = ChosenFolders(options_.pluginFolders);
  registry_ = std::make_unique<PluginRegistry>(pluginFolders_, &log_, options_.isStrict);
  world_.reset();
  worldBegin_.reset();
  render_.emplace(options_, dialect_);
  state_ = GraphicsState();
  stack_.Clear();
  coordinateSystems_.clear();
  errors_.DropDependent(false);
  hash_ = worldHash_ = std::uint64_t(dialect_);
  inputFiles_ = {sceneName_};
  outside_ = std::make_shared<std::vector<Directive>>();
}

void SceneBuilder::CheckScope(const Directive& directive) const {
  const std::string name(directive.spec->name);
  if (directive.spec->id == DirectiveId::WorldEnd && !world_)
    FailDependent(directive.Where(), "WorldEnd without WorldBegin");
  if (directive.spec->id == DirectiveId::WorldBegin && world_)
    FailDependent(directive.Where(),
                  "WorldBegin inside the world that begins at " + LocationText(*worldBegin_));
  if (directive.spec->scope == DirectiveScope::World && !world_)
    FailDependent(directive.Where(), name + " must be between WorldBegin and WorldEnd");
  if (directive.spec->scope == DirectiveScope::Options && world_)
    FailDependent(directive.Where(), name + " must be before WorldBegin");
}

void SceneBuilder::Handle(Directive directive) {
  if (options_.stop && *options_.stop) throw LoadingStopped();
  Directive name;  // without the parameters, which may be large
  name.spec = directive.spec;
  name.strings = directive.strings;
  name.params.where = directive.Where();
  if (!errors_.Try([&] { HandleOrThrow(std::move(directive)); })) RecoverFrom(name);
}

void SceneBuilder::AddToWorldHash(const Directive& directive) {
  const DirectiveId id = directive.spec->id;
  if (!world_ && id != DirectiveId::TransformTimes && id != DirectiveId::VolumeIntegrator &&
      id != DirectiveId::SearchPath)
    return;
  worldHash_ = HashDirective(worldHash_, directive);
  if (id != DirectiveId::CoordSysTransform) return;
  // The system may be the camera's.
  const auto system = coordinateSystems_.find(directive.strings[0]);
  if (system == coordinateSystems_.end()) return;
  for (const Transform& transform : {system->second.start, system->second.end})
    worldHash_ = HashTransform(worldHash_, transform);
}

void SceneBuilder::HandleOrThrow(Directive directive) {
  CheckScope(directive);
  hash_ = HashDirective(hash_, directive);
  AddToWorldHash(directive);
  NoteInputFiles(directive, &inputFiles_);
  const DirectiveId id = directive.spec->id;
  if (!world_ || id == DirectiveId::WorldEnd) outside_->push_back(directive);
  if (IsTransformDirective(id)) return ChangeTransform(directive);
  switch (id) {
    case DirectiveId::ActiveTransform:
      return SetActiveTransform(directive);
    case DirectiveId::TransformTimes:
      return SetTransformTimes(directive);
    case DirectiveId::CoordinateSystem:
      coordinateSystems_[directive.strings[0]] = state_.transform;
      return;
    case DirectiveId::CoordSysTransform:
      return UseCoordinateSystem(directive);
    case DirectiveId::SearchPath:
      return SetSearchPath(directive);
    case DirectiveId::WorldBegin:
      return BeginWorld(directive);
    case DirectiveId::WorldEnd:
      return EndWorld(directive);
    case DirectiveId::Camera:
      coordinateSystems_["camera"] = state_.transform.Inverted();
      break;
    default:
      break;
  }
  if (world_) return HandleWorld(std::move(directive));
  render_->Handle(std::move(directive), state_.transform);
}

void SceneBuilder::HandleWorld(Directive directive) {
  using Block = StateStack::Block;
  switch (directive.spec->id) {
    case DirectiveId::AttributeBegin:
      return stack_.Push(Block::Attribute, state_, directive.Where());
    case DirectiveId::AttributeEnd:
      return EndBlock(Block::Attribute, directive);
    case DirectiveId::TransformBegin:
      return stack_.Push(Block::Transform, state_, directive.Where());
    case DirectiveId::TransformEnd:
      return EndBlock(Block::Transform, directive);
    case DirectiveId::ObjectBegin:
      world_->BeginObject(directive);
      return stack_.Push(Block::Object, state_, directive.Where());
    case DirectiveId::ObjectEnd:
      return EndBlock(Block::Object, directive);
    case DirectiveId::ObjectInstance:
      return world_->AddInstance(directive, state_);
    case DirectiveId::ReverseOrientation:
      state_.reverseOrientation = !state_.reverseOrientation;
      return;
    case DirectiveId::Texture:
      return world_->DefineTexture(directive, &state_);
    case DirectiveId::Material:
      return SetMaterial(std::move(directive));
    case DirectiveId::MakeNamedMaterial:
      return MakeNamedMaterial(std::move(directive));
    case DirectiveId::NamedMaterial:
      return UseNamedMaterial(directive);
    case DirectiveId::LightSource:
      return world_->AddLight(directive, state_);
    case DirectiveId::AreaLightSource:
      state_.areaLight = world_->MakeAreaLightSpec(std::move(directive));
      return;
    case DirectiveId::Shape:
      return world_->AddShape(std::move(directive), state_);
    case DirectiveId::Volume:
      return world_->AddVolume(directive, state_);
    default:
      return;
  }
}

void SceneBuilder::EndBlock(StateStack::Block block, const Directive& directive) {
  stack_.Pop(block, std::string(directive.spec->name), directive.Where(), &state_);
  if (block == StateStack::Block::Object) world_->EndObject();
}

void SceneBuilder::ChangeTransform(const Directive& directive) {
  MovingTransform& current = state_.transform;
  if (state_.active == ActiveTimes::All && !current.Moves()) {
    // Equal transformations stay equal, however operations round.
    current.end = current.start = ApplyTransform(current.start, directive, dialect_);
    return;
  }
  if (state_.active != ActiveTimes::End)
    current.start = ApplyTransform(current.start, directive, dialect_);
  if (state_.active != ActiveTimes::Start)
    current.end = ApplyTransform(current.end, directive, dialect_);
  if (state_.active != ActiveTimes::All && directive.spec->id == DirectiveId::Rotate &&
      std::abs(directive.numbers[0]) > 180)
    CurrentLog().Warning(
        "a rotation by more than half a turn: moving objects rotate the shortest way",
        directive.Where());
}

void SceneBuilder::SetActiveTransform(const Directive& directive) {
  const std::string& when = directive.strings[0];
  const std::vector<std::string> known{"All", "StartTime", "EndTime"};  // in ActiveTimes order
  const auto found = std::find(known.begin(), known.end(), when);
  if (found == known.end())
    FailAt(directive.Where(),
           "unknown time \"" + when + "\" of ActiveTransform; known: All, StartTime, EndTime",
           DidYouMean(when, known));
  state_.active = ActiveTimes(found - known.begin());
}

void SceneBuilder::SetTransformTimes(const Directive& directive) {
  const Interval times{Real(directive.numbers[0]), Real(directive.numbers[1])};
  if (!(times.min < times.max) || !std::isfinite(times.min) || !std::isfinite(times.max))
    FailAt(directive.Where(), "TransformTimes: the end must come after the start");
  render_->SetTransformTimes(times);
}

void SceneBuilder::UseCoordinateSystem(const Directive& directive) {
  const std::string& name = directive.strings[0];
  const auto found = coordinateSystems_.find(name);
  if (found == coordinateSystems_.end()) {
    std::vector<std::string> known;
    for (const auto& [other, transform] : coordinateSystems_) known.push_back(other);
    FailDependent(directive.Where(), "no coordinate system \"" + name + "\" has been named",
                  DidYouMean(name, known));
  }
  state_.transform = found->second;
}

void SceneBuilder::SetMaterial(Directive directive) {
  state_.material = world_->MakeMaterialSpec(std::move(directive.strings[0]),
                                             std::move(directive.params), *state_.namedMaterials);
}

namespace {

// Returns the textures that the parameters name. If each material kept a table of all textures, the
// memory would grow with the product of their numbers.
std::shared_ptr<const TextureTable> NamedTextures(const ParamSet& params,
                                                  const TextureTable& defined) {
  std::vector<std::string> names;
  for (const ParsedParam& param : params.All())
    if (param.type == "texture")
      names.insert(names.end(), param.strings.begin(), param.strings.end());
  return std::make_shared<const TextureTable>(defined.Only(names));
}

}  // namespace

// In the syntax of version 2, the parameter "type" names the plugin.
void SceneBuilder::MakeNamedMaterial(Directive directive) {
  const std::string& name = directive.strings[0];
  const ParsedParam* type = directive.params.Find("type");
  if (!type || type->type != "string" || type->strings.size() != 1)
    FailAt(directive.Where(), "MakeNamedMaterial \"" + name +
                                  "\" needs a parameter \"string type\" with the material's name");
  ParamSet params;
  params.where = directive.Where();
  for (const ParsedParam& param : directive.params.All())
    if (param.name != "type") params.Add(param);
  std::shared_ptr<MaterialSpec> spec =
      world_->MakeMaterialSpec(type->strings[0], params, *state_.namedMaterials);
  spec->textures = NamedTextures(spec->params, *state_.textures);
  spec->label = name;
  MaterialMap& materials = state_.OwnNamedMaterials();
  if (materials.contains(name))
    CurrentLog().Warning("material \"" + name + "\" is defined again: later shapes use the new one",
                         directive.Where());
  materials[name] = std::move(spec);
}

void SceneBuilder::UseNamedMaterial(const Directive& directive) {
  const std::string& name = directive.strings[0];
  const auto found = state_.namedMaterials->find(name);
  if (found == state_.namedMaterials->end()) {
    std::vector<std::string> known;
    for (const auto& [other, spec] : *state_.namedMaterials) known.push_back(other);
    FailDependent(directive.Where(), "no material \"" + name + "\" has been defined",
                  DidYouMean(name, known));
  }
  state_.material = found->second;
}

// Decides whether a SearchPath folder may supply plugins. Scene files can come from untrusted
// sources, and plugins are native code. The folder must therefore lie inside a folder that the user
// chose, unless the user allowed scene plugins.
PluginFolder SceneBuilder::ClassifyPluginFolder(const std::string& path,
                                                const SourceLocation& where) {
  for (const std::string& chosen : options_.pluginFolders)
    if (LiesIn(path, chosen)) return {path, PluginTrust::Chosen};
  if (options_.allowsScenePlugins) return {path, PluginTrust::Allowed};
  log_.Notice("the scene's SearchPath \"" + path + "\" is not searched for plugins", where,
              "plugins are code that runs with your rights: --allow-scene-plugins allows this");
  return {path, PluginTrust::Skipped};
}

// Sets the plugin folders; "&" inserts the current ones. The user's and the program's own folders
// are always appended, so a scene with an outdated path still finds the standard plugins.
void SceneBuilder::SetSearchPath(const Directive& directive) {
  const std::string& text = directive.strings[0];
  PluginFolders folders;
  for (std::size_t at = 0; at <= text.size();) {
    const std::size_t end = std::min(text.find(':', at), text.size());
    const std::string folder = text.substr(at, end - at);
    if (folder == "&")
      folders.insert(folders.end(), pluginFolders_.begin(), pluginFolders_.end());
    else if (!folder.empty())
      folders.push_back(ClassifyPluginFolder(folder, directive.Where()));
    at = end + 1;
  }
  for (const std::string& folder : options_.pluginFolders) folders.push_back({folder});
  pluginFolders_ = std::move(folders);
  registry_ = std::make_unique<PluginRegistry>(pluginFolders_, &log_, options_.isStrict);
}

}  // namespace exphoton
