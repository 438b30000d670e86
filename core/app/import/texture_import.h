// SPDX-License-Identifier: BSD-2-Clause
// ImportTexture converts a texture of version 3 or 4.
#pragma once

#include <optional>
#include <string>

#include "core/app/import/import_context.h"
#include "core/app/import/reading/later_params.h"
#include "core/parser/syntax/directive.h"

namespace exphoton::cli {

// Returns the Texture directive.
std::string ImportTexture(const Directive& directive, const ImportContext& context);
// Returns whether the texture depends on the current matrix.
bool IsTextureInSpace(const Directive& directive);

}  // namespace exphoton::cli
