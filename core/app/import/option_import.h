// SPDX-License-Identifier: BSD-2-Clause
// ImportOption converts the directives before WorldBegin that choose plugins: film, sampler,
// filter, integrator, camera and accelerator.
#pragma once

#include <string>

#include "core/app/import/import_context.h"
#include "core/parser/syntax/directive.h"

namespace exphoton::cli {

// Returns the directive; "" for one that has no equivalent and does not need one. A film changes
// context->lightFactor.
std::string ImportOption(const Directive& directive, ImportContext* context);

// Returns a directive of versions 3 and 4 with its default plugin: for scenes that leave it out.
Directive DefaultOption(DirectiveId id, int version);

}  // namespace exphoton::cli
