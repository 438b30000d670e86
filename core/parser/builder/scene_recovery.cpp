// SPDX-License-Identifier: BSD-2-Clause
// SceneBuilder after an error: the state becomes as if the directive had been right, where this can
// be known, so that one mistake is reported once.
#include "core/parser/builder/scene_builder.h"

namespace exphoton {
namespace {

// Returns whether a directive has only strings, and all of them.
bool IsComplete(const Directive& directive) {
  const DirectiveSpec& spec = *directive.spec;
  return spec.numbers == 0 && !spec.hasParameters && !spec.hasWord &&
         spec.id != DirectiveId::Include && directive.strings.size() == std::size_t(spec.strings);
}

}  // namespace

bool SceneBuilder::Keep(const Error& error) {
  errors_.AddOfSyntax(error);
  return true;
}

// A misspelt directive without parameters is handled as the one that was probably meant. Whatever
// is wrong then may be due to this guess, so it is not reported.
void SceneBuilder::Recover(const Directive& directive) {
  if (!directive.spec || directive.spec->id == DirectiveId::Include) return ExpectMissingNames();
  if (!IsComplete(directive)) return RecoverFrom(directive);
  try {
    HandleOrThrow(directive);
  } catch (const Error&) {
    RecoverFrom(directive);
  }
}

void SceneBuilder::RecoverFrom(const Directive& directive) {
  switch (directive.spec->id) {
    case DirectiveId::ActiveTransform:
      state_.active = ActiveTimes::All;
      state_.transform.end = state_.transform.start;
      return;
    case DirectiveId::Camera:
      coordinateSystems_.try_emplace("camera", MovingTransform());
      return;
    case DirectiveId::CoordinateSystem:
      return ExpectMissingNames();
    case DirectiveId::WorldEnd:
      if (world_) Reset();
      return;
    case DirectiveId::AttributeEnd:
      return EndOpenBlocks(StateStack::Block::Attribute);
    case DirectiveId::TransformEnd:
      return EndOpenBlocks(StateStack::Block::Transform);
    case DirectiveId::ObjectEnd:
      return EndOpenBlocks(StateStack::Block::Object);
    case DirectiveId::Texture:
      if (world_) DefineMissingTexture(directive);
      return;
    case DirectiveId::ObjectBegin:
      if (world_) BeginMissingObject(directive);
      return;
    case DirectiveId::MakeNamedMaterial: {
      if (!world_) return;
      if (directive.strings.empty()) return ExpectMissingNames();
      ParamSet none;
      none.where = directive.Where();
      state_.OwnNamedMaterials().try_emplace(directive.strings[0],
                                             world_->MakeMaterialSpec("matte", none, {}));
      return;
    }
    default:
      return;
  }
}

void SceneBuilder::EndOpenBlocks(StateStack::Block block) {
  if (!world_ || !stack_.PopThrough(block, &state_)) return;
  if (!stack_.Has(StateStack::Block::Object)) world_->EndObject();
}

void SceneBuilder::DefineMissingTexture(const Directive& directive) {
  const std::vector<std::string>& strings = directive.strings;
  if (strings.empty()) return ExpectMissingNames();
  const std::string type = strings.size() < 2 ? "" : strings[1];
  const bool isColor = type == "color" || type == "spectrum", isFloat = type == "float";
  const auto isOpen = [&](bool ofColor) { return !state_.textures->Has(strings[0], ofColor); };
  if (!isColor && isOpen(false)) state_.OwnTextures().Define(strings[0], Uniform(Real(0)), {});
  if (!isFloat && isOpen(true)) state_.OwnTextures().Define(strings[0], Uniform(Spectrum()), {});
}

// An object within another one is faulty, and its end would end the outer one.
void SceneBuilder::BeginMissingObject(const Directive& directive) {
  if (directive.strings.empty()) ExpectMissingNames();
  stack_.Push(StateStack::Block::Object, state_, directive.Where());
}

void SceneBuilder::ExpectMissingNames() {
  errors_.DropDependent(true);
  state_.OwnTextures().AcceptAllNames();
}

}  // namespace exphoton
