// SPDX-License-Identifier: BSD-2-Clause
// LaterScan takes a scene for version 4 if it has a plugin or directive of that version alone, or
// no WorldEnd.
#include "core/app/import/reading/later_scan.h"

#include "core/parser/later_version.h"

namespace exphoton::cli {

std::string NamedMaterialType(const Directive& directive) {
  const ParsedParam* type = directive.params.Find("type");
  if (type && type->strings.size() == 1) return type->strings[0];
  throw Error(ExitStatus::Scene, "MakeNamedMaterial needs the class of the material",
              directive.Where(), "\"string type\" [\"matte\"], for example");
}

void LaterScan::Visit(const Directive& directive) {
  const DirectiveId id = directive.spec->id;
  if (IsOfVersion4(directive.spec->name, directive.strings.empty() ? "" : directive.strings[0]))
    isOf4_ = true;
  if (id == DirectiveId::WorldBegin) hasWorld_ = true;
  if (id == DirectiveId::WorldEnd) hasWorldEnd_ = true;
  if (id == DirectiveId::Material && directive.strings[0] == "mix") hasMix_ = true;
  if (id == DirectiveId::Texture)
    textures_.push_back({State().WithAttributes(directive, "texture"), State().Current()});
  if (id != DirectiveId::MakeNamedMaterial) return;
  const std::string type = NamedMaterialType(directive);
  if (type == "mix") hasMix_ = true;
  if (IsOfVersion4("Material", type)) isOf4_ = true;
  materials_.emplace_back(directive.strings[0], State().WithAttributes(directive, "material"));
}

void LaterScan::End(const SourceLocation& end) {
  if (!hasWorld_)
    throw Error(ExitStatus::Scene, "there is no WorldBegin, so this is no whole scene", end,
                "convert the file that includes it");
}

}  // namespace exphoton::cli
