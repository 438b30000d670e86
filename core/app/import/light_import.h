// SPDX-License-Identifier: BSD-2-Clause
// ImportLight and ImportAreaLight convert the lights of versions 3 and 4.
#pragma once

#include <string>

#include "core/app/import/import_context.h"
#include "core/parser/syntax/directive.h"

namespace exphoton::cli {

// Returns the directive; "" if the light is left out, which is reported.
std::string ImportLight(const Directive& directive, const ImportContext& context);
std::string ImportAreaLight(const Directive& directive, const ImportContext& context);

}  // namespace exphoton::cli
