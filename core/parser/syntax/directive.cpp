// SPDX-License-Identifier: BSD-2-Clause
// kDirectives lists the directives of versions 1 and 2. kLaterOnly lists those that only versions 3
// and 4 have.
#include "core/parser/syntax/directive.h"

#include <algorithm>
#include <array>
#include <utility>

namespace exphoton {
namespace {

using enum DirectiveScope;
using Id = DirectiveId;

DirectiveSpec Numbers(std::string_view name, Id id, int count) {
  return {.name = name, .id = id, .numbers = count};
}
DirectiveSpec Strings(std::string_view name, Id id, DirectiveScope scope, int count) {
  return {.name = name, .id = id, .scope = scope, .strings = count};
}
DirectiveSpec Named(std::string_view name, Id id, DirectiveScope scope, int strings = 1) {
  return {.name = name, .id = id, .scope = scope, .strings = strings, .hasParameters = true};
}

// clang-format off
const std::array kDirectives{
    Named("Accelerator", Id::Accelerator, Options),
    DirectiveSpec{.name = "ActiveTransform", .id = Id::ActiveTransform, .hasWord = true},
    Named("AreaLightSource", Id::AreaLightSource, World),
    Strings("AttributeBegin", Id::AttributeBegin, World, 0),
    Strings("AttributeEnd", Id::AttributeEnd, World, 0),
    Named("Camera", Id::Camera, Options),
    Numbers("ConcatTransform", Id::ConcatTransform, 16),
    Strings("CoordSysTransform", Id::CoordSysTransform, Anywhere, 1),
    Strings("CoordinateSystem", Id::CoordinateSystem, Anywhere, 1),
    Named("Film", Id::Film, Options),
    Numbers("Identity", Id::Identity, 0),
    Strings("Include", Id::Include, Anywhere, 1),
    Named("LightSource", Id::LightSource, World),
    Numbers("LookAt", Id::LookAt, 9),
    Named("MakeNamedMaterial", Id::MakeNamedMaterial, World),
    Named("Material", Id::Material, World),
    Strings("NamedMaterial", Id::NamedMaterial, World, 1),
    Strings("ObjectBegin", Id::ObjectBegin, World, 1),
    Strings("ObjectEnd", Id::ObjectEnd, World, 0),
    Strings("ObjectInstance", Id::ObjectInstance, World, 1),
    Named("PixelFilter", Id::PixelFilter, Options),
    Named("Renderer", Id::Renderer, Options),
    Strings("ReverseOrientation", Id::ReverseOrientation, World, 0),
    Numbers("Rotate", Id::Rotate, 4),
    Named("Sampler", Id::Sampler, Options),
    Numbers("Scale", Id::Scale, 3),
    Strings("SearchPath", Id::SearchPath, Options, 1),
    Named("Shape", Id::Shape, World),
    Named("SurfaceIntegrator", Id::SurfaceIntegrator, Options),
    Named("Texture", Id::Texture, World, 3),
    Numbers("Transform", Id::Transform, 16),
    Strings("TransformBegin", Id::TransformBegin, World, 0),
    Strings("TransformEnd", Id::TransformEnd, World, 0),
    DirectiveSpec{.name = "TransformTimes", .id = Id::TransformTimes, .scope = Options,
                  .numbers = 2},
    Numbers("Translate", Id::Translate, 3),
    Named("Volume", Id::Volume, World),
    Named("VolumeIntegrator", Id::VolumeIntegrator, Options),
    Strings("WorldBegin", Id::WorldBegin, Options, 0),
    Strings("WorldEnd", Id::WorldEnd, World, 0),
};

const std::array kLaterOnly{
    Named("Attribute", Id::Attribute, World),
    Strings("ColorSpace", Id::ColorSpace, Anywhere, 1),
    Strings("Import", Id::Import, World, 1),
    Named("Integrator", Id::Integrator, Options),
    Named("MakeNamedMedium", Id::MakeNamedMedium, Anywhere),
    Strings("MediumInterface", Id::MediumInterface, Anywhere, 1),
    Named("Option", Id::Option, Options, 0),
};

constexpr std::array<std::pair<std::string_view, std::string_view>, 7> kLaterDirectives{{
    {"Attribute", "4"}, {"ColorSpace", "4"}, {"Import", "4"}, {"Integrator", "3 or 4"},
    {"MakeNamedMedium", "3 or 4"}, {"MediumInterface", "3 or 4"}, {"Option", "4"},
}};
// clang-format on

// Returns whether versions 3 and 4 have the directive of versions 1 and 2, too.
bool IsInLater(Id id) {
  switch (id) {
    case Id::Renderer:
    case Id::SearchPath:
    case Id::SurfaceIntegrator:
    case Id::Volume:
    case Id::VolumeIntegrator:
      return false;
    default:
      return true;
  }
}

template <class List>
const DirectiveSpec* Find(const List& list, std::string_view name) {
  const auto found = std::find_if(list.begin(), list.end(),
                                  [&](const DirectiveSpec& spec) { return spec.name == name; });
  return found == list.end() ? nullptr : &*found;
}

}  // namespace

const DirectiveSpec* FindDirective(std::string_view name, SceneGrammar grammar) {
  const DirectiveSpec* found = Find(kDirectives, name);
  if (grammar == SceneGrammar::Early) return found;
  return found && IsInLater(found->id) ? found : Find(kLaterOnly, name);
}

std::vector<std::string> DirectiveNames(SceneGrammar grammar) {
  std::vector<std::string> names;
  const bool isLater = grammar == SceneGrammar::Later;
  for (const DirectiveSpec& spec : kDirectives)
    if (!isLater || IsInLater(spec.id)) names.emplace_back(spec.name);
  if (!isLater) return names;
  for (const DirectiveSpec& spec : kLaterOnly) names.emplace_back(spec.name);
  return names;
}

std::string_view LaterVersionOf(std::string_view name) {
  for (const auto& [directive, version] : kLaterDirectives)
    if (directive == name) return version;
  return {};
}

Error LaterVersionError(std::string_view version, const std::string& sign,
                        const SourceLocation& where) {
  const std::string command = "exphoton import " +
                              (where.includedFrom ? std::string("SCENE.pbrt") : where.file) +
                              " -o NEW.pbrt converts it";
  return {ExitStatus::Scene,
          "this is a scene of pbrt version " + std::string(version) + ", recognised by " + sign +
              ": versions 1 and 2 are read",
          where, command};
}

}  // namespace exphoton
