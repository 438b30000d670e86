// SPDX-License-Identifier: BSD-2-Clause
// ImportMaterial converts a material of version 3 or 4 to the nearest one here.
#pragma once

#include <optional>
#include <string>

#include "core/app/import/directive_text.h"
#include "core/app/import/import_context.h"
#include "core/app/import/reading/later_params.h"

namespace exphoton::cli {

// Head is the beginning of the directive that the material becomes: Material "uber", or
// MakeNamedMaterial "name" "string type" "uber".
struct MaterialHead {
  std::optional<std::string> name;  // of a named material
  DirectiveText Text(const std::string& material) const;
};

// Returns the directive. Returns nullopt for a surface that is invisible, because it only bounds
// media.
std::optional<std::string> ImportMaterial(const std::string& type, const MaterialHead& head,
                                          LaterParams& params, const ImportContext& context);

}  // namespace exphoton::cli
