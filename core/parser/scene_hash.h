// SPDX-License-Identifier: BSD-2-Clause
// HashDirective computes a hash of a scene's directives, independent of comments, layout,
// compression and the names of included files. The hash distinguishes scenes; it is not
// cryptographic.
#pragma once

#include <cstdint>

#include "core/math/transform.h"
#include "core/parser/syntax/directive.h"

namespace exphoton {

// Combines the hash of the preceding directives with this directive.
std::uint64_t HashDirective(std::uint64_t hash, const Directive& directive);
std::uint64_t HashTransform(std::uint64_t hash, const Transform& transform);

}  // namespace exphoton
