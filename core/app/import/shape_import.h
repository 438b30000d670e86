// SPDX-License-Identifier: BSD-2-Clause
// ImportShape converts the shapes of versions 3 and 4.
#pragma once

#include <string>

#include "core/app/import/import_context.h"
#include "core/parser/syntax/directive.h"

namespace exphoton::cli {

// `emits` says whether an area light is attached: the normals of a mesh then decide which side of a
// triangle shines. Returns "" for a shape that is left out, which is reported.
std::string ImportShape(const Directive& directive, bool emits, const ImportContext& context);

}  // namespace exphoton::cli
