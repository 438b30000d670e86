// SPDX-License-Identifier: BSD-2-Clause
// GraphicsState copies shared tables before a change. StateStack saves and restores states.
#include "core/parser/builder/graphics_state.h"

#include <algorithm>

#include "core/parser/builder/error_collector.h"

namespace exphoton {
namespace {

const char* BlockName(StateStack::Block block) {
  switch (block) {
    case StateStack::Block::Attribute:
      return "AttributeBegin";
    case StateStack::Block::Transform:
      return "TransformBegin";
    case StateStack::Block::Object:
      return "ObjectBegin";
  }
  return "";
}

}  // namespace

TextureTable& GraphicsState::OwnTextures() {
  if (textures.use_count() > 1) textures = std::make_shared<TextureTable>(*textures);
  return *textures;
}

MaterialMap& GraphicsState::OwnNamedMaterials() {
  if (namedMaterials.use_count() > 1)
    namedMaterials = std::make_shared<MaterialMap>(*namedMaterials);
  return *namedMaterials;
}

void StateStack::Push(Block block, const GraphicsState& state, const SourceLocation& where) {
  if (entries_.size() >= kMaxDepth)
    FailAt(where, "blocks are nested more than " + std::to_string(kMaxDepth) + " deep");
  entries_.push_back({block, state, where});
}

void StateStack::Pop(Block block, const std::string& name, const SourceLocation& where,
                     GraphicsState* state) {
  if (entries_.empty()) FailDependent(where, name + " without " + BlockName(block));
  Entry& entry = entries_.back();
  if (entry.block != block)
    FailDependent(where, name + " does not match the " + BlockName(entry.block) + " at " +
                             LocationText(entry.where));
  if (block == Block::Transform) {
    state->transform = entry.state.transform;
    state->active = entry.state.active;
  } else {
    *state = std::move(entry.state);
  }
  entries_.pop_back();
}

bool StateStack::Has(Block block) const {
  return std::any_of(entries_.begin(), entries_.end(),
                     [block](const Entry& entry) { return entry.block == block; });
}

bool StateStack::PopThrough(Block block, GraphicsState* state) {
  if (!Has(block)) return false;
  while (entries_.back().block != block) entries_.pop_back();
  *state = std::move(entries_.back().state);
  entries_.pop_back();
  return true;
}

const char* StateStack::InnermostName() const { return BlockName(entries_.back().block); }

std::string LocationText(const SourceLocation& where) {
  return where.file + ":" + std::to_string(where.line);
}

void FailAt(const SourceLocation& where, const std::string& text, const std::string& hint) {
  throw Error(ExitStatus::Scene, text, where, hint);
}

void FailDependent(const SourceLocation& where, const std::string& text, const std::string& hint) {
  throw DependentError(ExitStatus::Scene, text, where, hint);
}

}  // namespace exphoton
