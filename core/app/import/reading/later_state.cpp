// SPDX-License-Identifier: BSD-2-Clause
// LaterState follows the matrix of the start time only.
#include "core/app/import/reading/later_state.h"

#include "core/parser/builder/transform_directives.h"

namespace exphoton::cli {

void LaterState::End(DirectiveId begin, const Directive& directive) {
  if (saved_.empty() || saved_.back().begin != begin)
    throw Error(ExitStatus::Scene,
                std::string(directive.spec->name) + " ends no block that is open",
                directive.Where());
  const Transform transform = saved_.back().values.transform;
  const bool isActive = saved_.back().values.isActive;
  if (begin == DirectiveId::TransformBegin) {
    now_.transform = transform;
    now_.isActive = isActive;
  } else {
    now_ = std::move(saved_.back().values);
  }
  saved_.pop_back();
}

void LaterState::Handle(const Directive& directive) {
  if (IsTransformDirective(directive.spec->id)) {
    // Later versions mirror LookAt as version 2 does.
    if (now_.isActive) now_.transform = ApplyTransform(now_.transform, directive, Dialect::V2);
    return;
  }
  switch (directive.spec->id) {
    case DirectiveId::ActiveTransform:
      now_.isActive = directive.strings[0] != "EndTime";
      return;
    case DirectiveId::CoordinateSystem:
      coordinates_[directive.strings[0]] = now_.transform;
      return;
    case DirectiveId::CoordSysTransform:
      if (const auto found = coordinates_.find(directive.strings[0]); found != coordinates_.end())
        now_.transform = found->second;
      return;
    case DirectiveId::Camera:
      coordinates_["camera"] = now_.transform.Inverted();
      return;
    default:
      return HandleBlock(directive);
  }
}

void LaterState::HandleBlock(const Directive& directive) {
  switch (directive.spec->id) {
    case DirectiveId::WorldBegin:
      now_.transform = Transform();
      return;
    case DirectiveId::WorldEnd:
      *this = LaterState();
      return;
    case DirectiveId::AttributeBegin:
    case DirectiveId::TransformBegin:
    case DirectiveId::ObjectBegin:
      saved_.push_back({directive.spec->id, now_});
      return;
    case DirectiveId::AttributeEnd:
      return End(DirectiveId::AttributeBegin, directive);
    case DirectiveId::TransformEnd:
      return End(DirectiveId::TransformBegin, directive);
    case DirectiveId::ObjectEnd:
      return End(DirectiveId::ObjectBegin, directive);
    case DirectiveId::Attribute:
      for (const ParsedParam& param : directive.params.All())
        now_.attributes[directive.strings[0]].push_back(param);
      return;
    default:
      return;
  }
}

Directive LaterState::WithAttributes(Directive directive, const std::string& target) const {
  const auto found = now_.attributes.find(target);
  if (found == now_.attributes.end()) return directive;
  // The last of equal names counts.
  for (auto param = found->second.rbegin(); param != found->second.rend(); ++param)
    if (!directive.params.Find(param->name)) directive.params.Add(*param);
  return directive;
}

void LaterState::CheckEnd(const SourceLocation& where) const {
  if (saved_.empty()) return;
  throw Error(ExitStatus::Scene, "a block is open at the end of the file", where,
              "AttributeBegin, TransformBegin and ObjectBegin need their ends");
}

void LaterState::NameMaterial(const std::string& name, const Directive& definition) {
  materials_.resize(now_.materials);
  materials_.emplace_back(name, definition);
  now_.materials = materials_.size();
}

const Directive* LaterState::FindMaterial(const std::string& name) const {
  for (std::size_t i = now_.materials; i-- > 0;)
    if (materials_[i].first == name) return &materials_[i].second;
  return nullptr;
}

std::vector<std::string> LaterState::MaterialNames() const {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < now_.materials; ++i) names.push_back(materials_[i].first);
  return names;
}

}  // namespace exphoton::cli
