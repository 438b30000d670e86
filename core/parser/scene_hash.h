// SPDX-License-Identifier: BSD-2-Clause
// A number that stands for what a scene says, whatever its comments, layout, compression or file
// names. For telling scenes apart, not against malice.
#pragma once

#include <cstdint>

#include "core/parser/syntax/directive.h"

namespace exphoton {

// The hash of the directives so far and this one.
std::uint64_t HashDirective(std::uint64_t hash, const Directive& directive);

}  // namespace exphoton
